"""Pictures as PDF and SVG look like the PNG of the same command when drawn by independent programs, and
their texts are texts."""

import re
import shutil
import subprocess

import numpy as np
import pytest
from conftest import run_talus

Image = pytest.importorskip("PIL.Image", reason="Pillow is not installed: python3-pil")
for program, package in (("pdftocairo", "poppler-utils"), ("rsvg-convert", "librsvg2-bin")):
    if shutil.which(program) is None:
        pytest.skip(f"{program} is not installed: {package}", allow_module_level=True)

pytestmark = pytest.mark.chosen
WIDTH = 1600
#: Mean difference over all channels, relative to their range: edges of discs and letters are smoothed
#: differently.
TOLERANCE = 0.015
MAPS = ["gamma", "clusters+displacement", "pressure+forces"]


def pixels(path):
    return np.asarray(Image.open(path).convert("RGB"), dtype=float) / 255


def drawn(document):
    """Returns the picture drawn by a common program, WIDTH px wide."""
    made = document.with_name(document.name + ".png")
    if document.suffix == ".pdf":
        words = ["pdftocairo", "-png", "-singlefile", "-scale-to-x", WIDTH, "-scale-to-y", -1, document, made.with_suffix("")]
    else:
        words = ["rsvg-convert", "-w", WIDTH, document, "-o", made]
    subprocess.run([str(word) for word in words], check=True)
    return pixels(made)


def texts_of_pdf(path):
    return subprocess.run(["pdftotext", path, "-"], capture_output=True, text=True, check=True).stdout


@pytest.fixture(scope="module")
def pictures(analysed, tmp_path_factory):
    """Creates one picture of each map and a panel, in three formats."""
    folder = tmp_path_factory.mktemp("vector")
    options = ["--for", "paper", "--set", "gamma_c=0.342", "-q"]
    for ending in ("png", "pdf", "svg"):
        run_talus("render", analysed, "--map", ",".join(MAPS), "--at", "repose", "--trace", "overloaded", "--turned",
                  "--format", ending, "-o", folder, *options)
        run_talus("panel", analysed, "--map", "gamma,overloaded", "--at", "0,repose", "--title", "Two < three & four",
                  "-o", folder / f"panel.{ending}", *options)
    return folder


@pytest.mark.parametrize("ending", [".pdf", ".svg"])
def test_documents_look_as_the_png(pictures, ending):
    documents = sorted(pictures.glob(f"*{ending}"))
    assert len(documents) == len(MAPS) + 1
    for document in documents:
        wanted, found = pixels(document.with_suffix(".png")), drawn(document)
        assert abs(found.shape[0] - wanted.shape[0]) <= 1 and found.shape[1] == wanted.shape[1] == WIDTH
        rows = min(len(found), len(wanted))
        difference = np.abs(found[:rows] - wanted[:rows]).mean()
        assert difference < TOLERANCE, f"{document.name}: {difference}"
        # The same picture moved by two pixels must differ.
        assert np.abs(found[:rows - 2] - wanted[2:rows]).mean() > TOLERANCE, document.name


def test_texts_can_be_read_and_copied(pictures):
    pdf = texts_of_pdf(pictures / "panel.pdf")
    svg = re.sub(r"<[^>]*>", "", (pictures / "panel.svg").read_text(encoding="utf-8"))
    for text in ("θ = 0.00°", "θc = ", "Overloaded grains", "(d)", "γ = q/p"):
        assert text in pdf and text in svg, text
    assert "Two < three & four" in pdf and "Two &lt; three &amp; four" in svg
    fonts = subprocess.run(["pdffonts", pictures / "panel.pdf"], capture_output=True, text=True, check=True).stdout
    assert "DejaVuSans" in fonts and " no " not in fonts.splitlines()[2], "embedded"


def test_pages_have_the_width_of_print(pictures):
    info = subprocess.run(["pdfinfo", pictures / "panel.pdf"], capture_output=True, text=True, check=True).stdout
    width = float(re.search(r"Page size:\s+([\d.]+) x", info)[1])
    assert width == pytest.approx(17.8 / 2.54 * 72, abs=0.1)
    assert 'width="178.0000mm"' in (pictures / "panel.svg").read_text(encoding="utf-8")
    across, along = Image.open(pictures / "panel.png").info["dpi"]
    assert across == along == pytest.approx(WIDTH / (17.8 / 2.54), abs=0.1)
