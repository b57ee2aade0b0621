"""Stress ratio of a tensor, as computed by Talus."""

import numpy as np

from talus.errors import WrongType


def stress_ratio(moment: np.ndarray) -> np.ndarray:
    """Returns q/p of tensors (..., 2, 2), which are internal moments or stresses, single or summed: (s1 - s2) / (s1 +
    s2) of the principal values of the symmetric part. NaN if a tensor carries no load (its trace is not above 0)."""
    try:
        moment = np.asarray(moment, dtype=float)
    except (TypeError, ValueError):
        moment = np.zeros(0)
    if moment.shape[-2:] != (2, 2):
        raise WrongType("stress_ratio: expected tensors, numbers of shape (..., 2, 2)")
    trace = moment[..., 0, 0] + moment[..., 1, 1]
    deviator = np.hypot(moment[..., 0, 0] - moment[..., 1, 1], moment[..., 0, 1] + moment[..., 1, 0])
    return np.divide(deviator, trace, out=np.full_like(trace, np.nan), where=trace > 0)
