"""Put pictures of one size side by side, each under its caption.

    side_by_side.py OUT.png CAPTION=PICTURE.png...
"""

import sys

from matplotlib import image, pyplot

DOTS_PER_INCH = 100
GAP_PIXELS = 8
CAPTION_PIXELS = 32


def main(path, panels):
    pictures = [image.imread(file) for _, file in panels]
    height, width = pictures[0].shape[:2]
    step = width + GAP_PIXELS
    size = (len(panels) * step - GAP_PIXELS, height + CAPTION_PIXELS)
    figure = pyplot.figure(figsize=[side / DOTS_PER_INCH for side in size], dpi=DOTS_PER_INCH)
    for i, ((caption, _), picture) in enumerate(zip(panels, pictures, strict=True)):
        figure.figimage(picture, i * step, 0)
        figure.text(
            (i * step + width / 2) / size[0],
            1 - CAPTION_PIXELS / 2 / size[1],
            caption,
            ha="center",
            va="center",
            fontsize=14,
        )
    figure.savefig(path, metadata={"Software": None})


if __name__ == "__main__":
    main(sys.argv[1], [argument.rsplit("=", 1) for argument in sys.argv[2:]])
