"""Tables of data sets of a run."""

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from talus.errors import Closed, Error, MissingName, check_text, suggestion
from talus.optional import need

if TYPE_CHECKING:
    from talus.run import Run


#: Data sets that an analysis has once, whatever the number of its frames.
OF_THE_RUN = ("threshold", "theta_d/", "correlation/distance", "lc/end_ratio", "events/")


class Table(Closed, Mapping[str, Any]):
    """The data sets of a group of the run file, by name: `run.observables["tilt"]`,
    `run.analysis["overloaded/fraction"]`. Values are arrays, in the units of the run, or plain numbers and texts; they
    are read on access. NaN means "no value"."""

    def __init__(self, run: "Run", group: str) -> None:
        self._run = run
        self._group = group
        self._names = run.storage.names(group)
        self._is_closed = True

    def __getitem__(self, name: str) -> Any:
        if check_text(name, "the data set") not in self._names:
            raise MissingName(f"{name}: no such data set in /{self._group} of {self._run.path}{suggestion(name, self._names)}")
        return self._run[f"{self._group}/{name}"]

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __repr__(self) -> str:
        return f"<{len(self)} data sets of /{self._group}: {', '.join(self._names)}>"

    def unit(self, name: str) -> str:
        """Returns the unit of the values of `name`; "1" for a plain number."""
        self._known(name)
        return self._run.unit(f"{self._group}/{name}")

    def meaning(self, name: str) -> str:
        """Returns the definition of `name`, a sentence; empty while the run is being computed."""
        self._known(name)
        return self._run.meaning(f"{self._group}/{name}")

    def to_pandas(self) -> Any:
        """Returns a DataFrame with one row for each row of a series; for /analysis one for each frame of the tilt. Its
        columns are the data sets with one number per row and, as `name`, `name[1]`, ..., those with up to four, e.g.
        one for each threshold; the table of /analysis starts with `tilt`. Raises ImportError without pandas, and Error
        if there are no rows yet."""
        pandas = need("pandas", "to_pandas()")
        columns: dict[str, Any] = {}
        rows = None
        if self._group == "analysis":
            rows = self._run.frames_of_tilt
            columns["tilt"] = self._run["frames/tilt"][:rows]
        for name in self._names:
            values = self[name]
            shape = getattr(values, "shape", ())
            if rows is None and len(shape) == 1:
                rows = shape[0]
            if self._group == "analysis" and name.startswith(OF_THE_RUN) or name.endswith(("edge", "clusters/direction")):
                continue
            if len(shape) == 1 and shape[0] == rows:
                columns[name] = values
            elif len(shape) == 2 and shape[0] == rows and shape[1] <= 4:
                columns.update({numbered(name, i): values[:, i] for i in range(shape[1])})
        if not columns:
            raise Error(f"/{self._group} of {self._run.path} holds no rows yet")
        return pandas.DataFrame(columns)

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and name in self._names

    def _known(self, name: str) -> None:
        if name not in self:
            self[name]


def numbered(name: str, i: int) -> str:
    """Returns the name of number i of several: "lc/mean", "lc/mean[1]"."""
    return name if i == 0 else f"{name}[{i}]"
