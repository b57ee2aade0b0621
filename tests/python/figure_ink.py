"""Positions of the texts of a figure: the ink of each glyph on the page, from its PDF."""

import re
from dataclasses import dataclass

import fitz

TALL = set("bdfhklt0123456789()[]{}/|ABCDEFGHIJKLMNOPQRSTUVWXYZΓΔθ°")
DEEP = set("gjpqy()[]{}/|,;Qγμρ")


@dataclass
class Glyph:
    letter: str
    label: int  # glyphs of one label may touch each other, those of different labels must not
    box: tuple  # left, top, right, bottom in points
    size: float


def glyph_box(letter, origin, advance_box, size, direction):
    """Returns the ink of a glyph drawn from `origin` along `direction`."""
    along = abs(direction[0]) > 0.5
    length = (advance_box[2] - advance_box[0]) if along else (advance_box[3] - advance_box[1])
    up = 0.74 * size if letter in TALL else 0.57 * size
    if letter in "-−–=~":
        up = 0.45 * size
    down = 0.22 * size if letter in DEEP else 0.0
    x, y = origin
    if along:
        left, right = (x, x + length) if direction[0] > 0 else (x - length, x)
        return (left, y - up, right, y + down)
    if direction[1] < 0:  # upwards: the top of the letters is on the left
        return (x - up, y - length, x + down, y)
    return (x - down, y, x + up, y + length)


def follows(glyph_end, origin, size, direction):
    """Returns whether a glyph continues at the end of the previous one, like sub- and superscripts."""
    dx, dy = origin[0] - glyph_end[0], origin[1] - glyph_end[1]
    along = dx * direction[0] + dy * direction[1]
    across = abs(-dx * direction[1] + dy * direction[0])
    return -0.2 * size < along < 0.06 * size and across < 0.7 * size


def glyphs_of(page):
    """Returns all glyphs of a page in drawing order, without blanks."""
    glyphs, label, end, before = [], 0, None, None
    flags = fitz.TEXT_PRESERVE_LIGATURES | fitz.TEXT_PRESERVE_WHITESPACE | fitz.TEXT_INHIBIT_SPACES
    blocks = page.get_text("rawdict", clip=fitz.INFINITE_RECT(), flags=flags)["blocks"]
    lines = [line for block in blocks for line in block.get("lines", [])]
    for direction, span in [(line["dir"], span) for line in lines for span in line["spans"]]:
        for char in span["chars"]:
            origin, box, size = char["origin"], char["bbox"], span["size"]
            length = (box[2] - box[0]) if abs(direction[0]) > 0.5 else (box[3] - box[1])
            if end is None or direction != before or not follows(end, origin, size, direction):
                label += 1
            end = (origin[0] + length * direction[0], origin[1] + length * direction[1])
            before = direction
            letter = char["c"]
            if not letter.isspace():
                glyphs.append(Glyph(letter, label, glyph_box(letter, origin, box, size, direction), size))
    return glyphs


def overlap(one, other, room):
    """Returns whether two boxes overlap or are closer to each other than `room`."""
    return (
        one[0] < other[2] + room
        and other[0] < one[2] + room
        and one[1] < other[3] - 0.3 * room
        and other[1] < one[3] - 0.3 * room
    )


def segments_of(page):
    """Returns straight strokes outside panels: samples of keys, scale bars, arrows, and the frames of
    panels."""
    strokes = []
    for drawing in page.get_drawings():
        if drawing["type"] not in ("s", "fs"):
            continue
        for item in drawing["items"]:
            if item[0] == "l":
                strokes.append((item[1].x, item[1].y, item[2].x, item[2].y))
            elif item[0] == "re":
                box = item[1]
                corners = [(box.x0, box.y0), (box.x1, box.y0), (box.x1, box.y1), (box.x0, box.y1)]
                strokes += [(*corners[k], *corners[(k + 1) % 4]) for k in range(4)]
    return strokes


def frames_of(strokes):
    """Returns the panels: pairs of horizontal and vertical strokes that form a rectangle."""
    across = {(round(min(a, c), 1), round(max(a, c), 1), round(b, 1)) for a, b, c, d in strokes if abs(b - d) < 0.05 and abs(a - c) > 15}
    upright = {(round(a, 1), round(min(b, d), 1), round(max(b, d), 1)) for a, b, c, d in strokes if abs(a - c) < 0.05 and abs(b - d) > 8}
    frames = set()
    for left, low, high in upright:
        for x0, x1, y in across:
            if abs(x0 - left) < 0.2 and abs(y - low) < 0.2 and (x0, x1, high) in across:
                frames.add((x0, low, x1, high))
    return frames


def crosses(stroke, box):
    """Returns whether a stroke crosses a box slightly smaller than the ink."""
    shrink = 0.12 * (box[3] - box[1])
    left, top, right, bottom = box[0] + shrink, box[1] + shrink, box[2] - shrink, box[3] - shrink
    x0, y0, x1, y1 = stroke
    steps = max(2, int(max(abs(x1 - x0), abs(y1 - y0))))
    if max(x0, x1) < left or min(x0, x1) > right or max(y0, y1) < top or min(y0, y1) > bottom:
        return False
    return any(
        left < x0 + (x1 - x0) * k / steps < right and top < y0 + (y1 - y0) * k / steps < bottom for k in range(steps + 1)
    )


def without_clipped(content):
    """Returns the content stream of a page of matplotlib without the paths that are drawn in a clip: those of panels, which end
    at the frame."""
    lines, clipped, in_text = [], [False], False
    for line in content.split(b"\n"):
        words = line.split()
        in_text = (in_text or words[:1] == [b"BT"]) and words[:1] != [b"ET"]
        for word in [] if in_text else words:
            if word == b"q":
                clipped.append(clipped[-1])
            elif word == b"Q":
                clipped.pop()
            elif word == b"W":
                clipped[-1] = True
        painted = not in_text and clipped[-1] and words and words[-1] in (b"S", b"s", b"f", b"f*", b"B", b"B*", b"b", b"b*")
        lines.append(b"n" if painted else b"" if clipped[-1] and words[-1:] == [b"Do"] else line)
    return b"\n".join(lines)


def faults(pdf):
    """Returns the faults of a figure's texts, in words; empty if all are legible."""
    with fitz.open(pdf) as document:
        page = document[0]
        glyphs = glyphs_of(page)
        for content in page.get_contents():
            document.update_stream(content, without_clipped(document.xref_stream(content)))
        strokes = segments_of(page)
        width, height = page.rect.width, page.rect.height
    found = []

    labels = {}
    for glyph in glyphs:
        labels[glyph.label] = labels.get(glyph.label, "") + glyph.letter

    def name(glyph):
        return f"'{labels[glyph.label]}'"

    for glyph in glyphs:
        left, top, right, bottom = glyph.box
        if left < 0.3 or top < 0.3 or right > width - 0.3 or bottom > height - 0.3:
            found.append(f"{name(glyph)} crosses the edge of the page")
        if glyph.size < 3.5:
            found.append(f"{name(glyph)} has letters of {glyph.size:.1f} points")
    glyphs.sort(key=lambda glyph: glyph.box[0])
    for k, one in enumerate(glyphs):
        for other in glyphs[k + 1 :]:
            if other.box[0] > one.box[2] + 2:
                break
            if one.letter == other.letter and max(abs(a - b) for a, b in zip(one.box, other.box)) < 0.1:
                continue  # printed twice in one place
            if one.label != other.label and overlap(one.box, other.box, 0.12 * min(one.size, other.size)):
                found.append(f"{name(one)} meets {name(other)}")
    frames = frames_of(strokes)
    for stroke in strokes:
        x0, y0, x1, y1 = stroke
        # A stroke that enters a panel is clipped at its frame.
        inside = any(
            min(x0, x1) < c - 0.2 and max(x0, x1) > a + 0.2 and min(y0, y1) < d - 0.2 and max(y0, y1) > b + 0.2 for a, b, c, d in frames
        )
        if inside:
            continue
        for glyph in glyphs:
            if crosses(stroke, glyph.box):
                found.append(f"{name(glyph)} is crossed by a line")
    # Letters of panels count from (a), and a single panel has none.
    panels = sorted(match[1] for label in labels.values() if (match := re.match(r"\(([a-z])\)", label)))
    expected = [chr(ord("a") + k) for k in range(max(2, len(panels)))] if panels else []
    if panels != expected:
        found.append(f"the panels are lettered {', '.join(panels)}, not {', '.join(expected)}")
    return sorted(set(found))
