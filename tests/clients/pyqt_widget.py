"""A QVTKRenderWindowInteractor of PyQt. Input ends it."""

from PyQt5.QtCore import QSocketNotifier
from PyQt5.QtWidgets import QApplication
from vtkmodules.qt.QVTKRenderWindowInteractor import QVTKRenderWindowInteractor

import client

application = QApplication([])
widget = QVTKRenderWindowInteractor()
widget.setGeometry(0, 0, *client.SIZE)
client.fill(widget.GetRenderWindow(), widget.GetRenderWindow().GetInteractor())
widget.Initialize()
widget.show()
notifier = QSocketNotifier(0, QSocketNotifier.Read)
notifier.activated.connect(application.quit)
application.exec()
widget.Finalize()
