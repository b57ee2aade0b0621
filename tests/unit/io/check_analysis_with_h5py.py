"""Opens a packed run with an analysis with h5py and checks the attributes of its numbers.

Usage: check_analysis_with_h5py.py RUN.h5
"""
import sys

import h5py
import numpy as np


def check_attributes(analysis):
    data_sets = []
    analysis.visititems(lambda name, item: data_sets.append(item) if isinstance(item, h5py.Dataset) else None)
    assert len(data_sets) > 50
    for item in data_sets:
        assert item.attrs["unit"], item.name
        if not item.name.startswith("/analysis/parameters/"):
            assert len(item.attrs["definition"]) > 3, item.name
            assert item.attrs["parameters"], item.name


def main():
    with h5py.File(sys.argv[1], "r") as file:
        analysis = file["analysis"]
        check_attributes(analysis)
        assert analysis["clusters/largest"].attrs["parameters"] == (
            b"threshold_factors = 1,2; gamma_c = run; averaging = 0"
        )
        assert analysis["packing/stress"].attrs["parameters"] == b"averaging = 0"
        assert analysis["packing/volume"].attrs["parameters"] == b"none"
        assert analysis["packing/stress"].attrs["unit"] == b"Pa"
        length = analysis["lc/length"]
        assert length.dtype == np.float32 and length.shape == (len(file["frames/tilt"]), 2, 6)
        assert length.chunks == (1, 2, 6) and length.shuffle and length.compression == "gzip"
        assert np.isnan(length[0, 0, 0]) and not np.isnan(length[0, 0, 1])


main()
