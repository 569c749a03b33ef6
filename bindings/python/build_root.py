"""The folder of the Cargo workspace: in an sdist a copy of it, else the repository."""

from pathlib import Path

HERE = Path(__file__).resolve().parent
#: The name of the copy; pyproject.toml says what is in it.
COPY = HERE / "workspace"
ROOT = COPY if COPY.exists() else HERE.parents[1]
