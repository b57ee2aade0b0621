"""The stress ratio of a tensor, as Talus computes it."""

import numpy as np

from talus.errors import WrongType


def stress_ratio(moment: np.ndarray) -> np.ndarray:
    """q/p of tensors (..., 2, 2), internal moments or stresses, alone or summed: (s1 - s2) / (s1 + s2) of the
    principal values of the symmetric part. NaN where a tensor carries nothing (its trace is not above 0)."""
    try:
        moment = np.asarray(moment, dtype=float)
    except (TypeError, ValueError):
        moment = np.zeros(0)
    if moment.shape[-2:] != (2, 2):
        raise WrongType("stress_ratio: expected numbers of shape (..., 2, 2), the tensors")
    trace = moment[..., 0, 0] + moment[..., 1, 1]
    deviator = np.hypot(moment[..., 0, 0] - moment[..., 1, 1], moment[..., 0, 1] + moment[..., 1, 0])
    return np.divide(deviator, trace, out=np.full_like(trace, np.nan), where=trace > 0)
