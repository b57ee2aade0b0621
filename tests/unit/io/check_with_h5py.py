"""Opens a packed run with h5py and checks units, help and the essentials of H5MD 1.1.

Usage: check_with_h5py.py RUN.h5
"""
import sys

import h5py
import numpy as np


def data_sets(file):
    found = {}
    file.visititems(lambda name, item: found.update({name: item}) if isinstance(item, h5py.Dataset) else None)
    return found


def check_h5md(file, frames, grains):
    assert list(file["h5md"].attrs["version"]) == [1, 1]
    assert file["h5md/author"].attrs["name"]
    assert file["h5md/creator"].attrs["name"] == b"talus" and file["h5md/creator"].attrs["version"]
    group = file["particles/grains"]
    assert group["box"].attrs["dimension"] == 2
    assert list(group["box"].attrs["boundary"]) == [b"periodic", b"none"]
    assert group["box/edges"].shape == (2,)
    elements = {"position": (2,), "image": (2,), "velocity": (2,), "angle": (), "angular_velocity": (),
                "internal_moment": (2, 2), "gamma": ()}
    for name, shape in elements.items():
        element = group[name]
        assert set(element) == {"value", "step", "time"}, name
        assert element["value"].shape == (frames, grains) + shape, name
        assert element["value"].chunks == (1, grains) + shape, name
        assert element["value"].shuffle and element["value"].compression == "gzip", name
        assert element["step"].shape == element["time"].shape == (frames,), name
        assert np.all(np.diff(element["step"]) > 0), name
        assert element["step"] == file["frames/step"], "one data set with several names"
    for name in ["id", "species", "radius", "mass"]:
        assert group[name].shape == (grains,), name
    assert np.issubdtype(group["id"].dtype, np.integer) and np.issubdtype(group["species"].dtype, np.integer)


def check_texts(file):
    for path, item in data_sets(file).items():
        assert "unit" in item.attrs, path
        assert h5py.check_string_dtype(item.dtype) is None or h5py.check_string_dtype(item.dtype).length, path
        named_by_the_run = path.startswith(("provenance/", "results/", "checkpoint/integers/", "checkpoint/reals/"))
        if not path.startswith("help/") and not named_by_the_run and not path.endswith(("/step", "/time")):
            assert len(file["help/" + path][()]) > 3, path


def check_units(file):
    assert file["particles/grains/radius"].attrs["unit"] == b"m"
    assert file["particles/grains/internal_moment/value"].attrs["unit"] == b"J/m", "per metre of thickness"
    assert file["contacts/force"].attrs["unit"] == b"N/m"
    assert file["parameters/scenario_given"][()].decode() == "seed = 3\n# \u03b8 in a comment\n"
    assert list(file["particles/grains/species"]) == [0, 0, 0, 0, 1, 1]


def main():
    with h5py.File(sys.argv[1], "r") as file:
        assert file.userblock_size == 512
        check_h5md(file, 4, 6)
        check_texts(file)
        check_units(file)


main()
