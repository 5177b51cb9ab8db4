"""A wxVTKRenderWindowInteractor in a frame of wxPython. Input ends it."""

import sys
import threading

import wx
from vtkmodules.wx.wxVTKRenderWindowInteractor import wxVTKRenderWindowInteractor

import client

application = wx.App()
frame = wx.Frame(None, pos=(0, 0))
frame.SetClientSize(client.SIZE)
widget = wxVTKRenderWindowInteractor(frame, -1, size=client.SIZE)
widget.Enable(1)
client.fill(widget.GetRenderWindow(), widget.GetRenderWindow().GetInteractor())
frame.Show()


def end_with_input():
    sys.stdin.readline()
    wx.CallAfter(frame.Close)


threading.Thread(target=end_with_input, daemon=True).start()
application.MainLoop()
