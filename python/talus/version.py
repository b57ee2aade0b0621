"""The version of this package, that of the Talus it comes with, and what it reads."""

__version__ = "0.1.0"

#: Version of the table of data sets in docs/file_format.md.
SCHEMA = 4

#: Version of the table of data sets in docs/analysis.md.
ANALYSIS = 6
