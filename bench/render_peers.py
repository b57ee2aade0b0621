#!/usr/bin/env python3
"""Measures drawing and writing the same picture of discs by Talus, cairo, matplotlib and ParaView. Prints a Markdown table.

usage: render_peers.py BUILD
BUILD is the folder of render_bench and render_cairo. A peer that is not installed is omitted and reported.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

PICTURES = [(8000, 1600, "gray"), (8000, 1600, "colour"), (100000, 4000, "gray"), (100000, 4000, "colour")]
REPEATS = 5


def talus(build, folder):
    """Returns median milliseconds by stage/discs/palette."""
    result = subprocess.run([os.path.join(build, "render_bench"), "--benchmark_repetitions=5", "--benchmark_format=json",
                             "--benchmark_report_aggregates_only=true", "--benchmark_min_time=0.3"],
                            cwd=folder, check=True, capture_output=True, text=True)
    return {entry["run_name"].removesuffix("/real_time"): entry["real_time"]
            for entry in json.loads(result.stdout)["benchmarks"] if entry["aggregate_name"] == "median"}


def cairo(build, folder, discs, palette):
    """Returns the milliseconds of a frame, and writes the discs to discs.csv."""
    result = subprocess.run([os.path.join(build, "render_cairo"), str(discs), palette, "cairo.png", "discs.csv"],
                            cwd=folder, check=True, capture_output=True, text=True)
    return float(result.stdout.split()[1])


def matplotlib_frame(discs, width, path):
    """Draws one frame with Agg in a new figure, like a script that makes a series of frames."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.collections import EllipseCollection
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width / 100, width / 400), dpi=100)
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_axes([0, 0, 1, 1])
    axes.set(xlim=(0, width), ylim=(0, width / 4))
    axes.axis("off")
    radius = discs["radius"]
    rim = np.minimum(0.18 * radius, 2.0)  # a line is centred on the edge of its ellipse
    axes.add_collection(EllipseCollection(
        2 * radius - rim, 2 * radius - rim, np.zeros(len(radius)), units="xy", transOffset=axes.transData,
        offsets=np.column_stack([discs["x"], discs["y"]]), linewidths=0.72 * rim, facecolors=colours(discs, "fill"),
        edgecolors=colours(discs, "rim")))
    canvas.print_png(path)


def colours(discs, part):
    return np.column_stack([discs[f"{part}_{name}"] for name in ("red", "green", "blue")]) / 255


def paraview_frames(discs, width, path):
    """Returns a function that draws one frame: discs as point sprites with their sizes and colours."""
    from paraview import simple
    from paraview.vtk.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkPolyData

    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.column_stack([discs["x"], discs["y"], np.zeros(len(discs))]), deep=True))
    data = vtkPolyData()
    data.SetPoints(points)
    for name, values in (("radius", discs["radius"]), ("colour", (255 * colours(discs, "fill")).astype(np.uint8))):
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        data.GetPointData().AddArray(array)
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    view = simple.CreateRenderView(ViewSize=[width, width // 4], Background=[1, 1, 1], OrientationAxesVisibility=0)
    shown = simple.Show(source, view)
    shown.Representation = "Point Gaussian"
    shown.ShaderPreset = "Plain circle"
    shown.ScaleByArray, shown.SetScaleArray, shown.GaussianRadius = 1, ["POINTS", "radius"], 1.0
    simple.ColorBy(shown, ("POINTS", "colour"))
    shown.MapScalars = 0
    view.CameraParallelProjection = 1
    view.CameraFocalPoint, view.CameraPosition = [width / 2, width / 8, 0], [width / 2, width / 8, 1000]
    view.CameraParallelScale = width / 8
    return lambda: simple.SaveScreenshot(path, view, ImageResolution=[width, width // 4])


def median_ms(draw):
    draw()  # loads fonts and libraries
    times = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        draw()
        times.append(1000 * (time.perf_counter() - start))
    return statistics.median(times)


def available(module):
    try:
        __import__(module)
        return True
    except ImportError:
        return False


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", help="folder of render_bench and render_cairo")
    parser.add_argument("--keep", help="folder in which to keep the pictures")
    arguments = parser.parse_args()
    build = os.path.abspath(arguments.build)
    peers = [name for name in ("matplotlib", "paraview") if available(name)]
    with tempfile.TemporaryDirectory(dir=build) as temporary:
        folder = arguments.keep or temporary
        ours = talus(build, folder)
        print("Median wall times in ms: a frame is a picture drawn and its PNG on disk; overlapped means that a\n"
              "second thread writes a frame while the next one is drawn.\n")
        print("| discs | width, px | | Talus: draw | PNG | frame | frame, overlapped | cairo: frame | "
              + " | ".join(f"{name}: frame" for name in peers) + " |")
        print("|--:|--:|---|" + "--:|" * (5 + len(peers)))
        for discs, width, palette in PICTURES:
            row = [f"{ours[f'{stage}/{discs}/{palette}']:.1f}" for stage in ("draw", "png", "frame", "frame_overlapped")]
            row.append(f"{cairo(build, folder, discs, palette):.0f}")
            table = np.genfromtxt(os.path.join(folder, "discs.csv"), delimiter=",", names=True)
            if "matplotlib" in peers:
                row.append(f"{median_ms(lambda: matplotlib_frame(table, width, os.path.join(folder, 'matplotlib.png'))):.0f}")
            if "paraview" in peers:
                row.append(f"{median_ms(paraview_frames(table, width, os.path.join(folder, 'paraview.png'))):.0f}")
            print(f"| {discs} | {width} | {palette} | " + " | ".join(row) + " |", flush=True)
    for name in ("matplotlib", "paraview"):
        if name not in peers:
            print(f"\n{name} is not installed and therefore omitted (Debian: python3-{name}).")
    return 0


if __name__ == "__main__":
    sys.exit(main())
