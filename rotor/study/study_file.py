"""Study files: TOML that a person can read, and the examples that come with the package."""

from dataclasses import dataclass
from pathlib import Path

from rotor.assets import asset_path
from rotor.study.document import Document
from rotor.study.reader import Reader
from rotor.study.study import Study


@dataclass(frozen=True)
class StudyFile:
    """A study and the text it was read from."""

    study: Study
    text: str
    path: str


def read_study(path: str | Path) -> StudyFile:
    """Read a study file, or one that comes with the package by its name. ValueError with one sentence."""
    path = Path(path)
    if not path.exists() and path.parent == Path() and path.name:
        try:
            path = asset_path(f"studies/{path.name}")
        except FileNotFoundError:
            examples = ", ".join(sorted(one.name for one in asset_path("studies").glob("*.toml")))
            raise ValueError(
                f"study file {path.name!r} does not exist: give a TOML file, or an example of the package: {examples}"
            ) from None
    try:
        text = path.read_text(encoding="utf-8-sig")  # Notepad puts a mark before the text.
    except FileNotFoundError:
        raise ValueError(f"study file {str(path)!r} does not exist: give the path of a TOML file") from None
    except (OSError, UnicodeDecodeError) as error:
        raise ValueError(f"study file {str(path)!r} cannot be read ({error}): give a TOML text file") from None
    return StudyFile(parse_study(text, str(path)), text, str(path))


def parse_study(text: str, name: str = "study.toml") -> Study:
    """The study of a file's text. ValueError with one sentence that names file, line, key and remedy."""
    return Reader(Document(text, name), Path(name)).study()
