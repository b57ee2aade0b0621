#!/usr/bin/env python3
"""Makes a PNG small enough for a page: /usr/bin/python3 reduce.py FROM.png TO.png [COLOURS]

It becomes at most 1100 pixels wide, and gets a palette of so many colours [96], which are as good as all in pictures of
discs and curves. Needs Debian's python3-pil."""

import sys

from PIL import Image

WIDTH = 1100


def main(source, target, colours="96"):
    picture = Image.open(source).convert("RGB")
    if picture.width > WIDTH:
        picture = picture.resize((WIDTH, round(picture.height * WIDTH / picture.width)), Image.Resampling.LANCZOS)
    picture.quantize(int(colours), kmeans=3, dither=Image.Dither.NONE).save(target, optimize=True)


if __name__ == "__main__":
    if not 3 <= len(sys.argv) <= 4 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    main(*sys.argv[1:])
