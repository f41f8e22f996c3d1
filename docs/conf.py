"""The documentation site: `make docs` builds it with Sphinx, warnings as errors, into `dist/docs`.

Markdown is read by MyST, the notebooks are run by sphinx-gallery, formulas become MathML. No page holds a typed result:
`command-output` shows what a command of `rotor` prints, `picture` draws one of `pictures.py`, `commands` prints the
help of every command. The built pages ask no other host for anything; the last step of the build checks that.
"""

import argparse
import io
import os
import re
import shlex
import sys
from contextlib import chdir, redirect_stderr, redirect_stdout
from pathlib import Path

import matplotlib
from docutils import nodes
from docutils.parsers.rst import directives
from latex2mathml.converter import convert
from sphinx.application import Sphinx
from sphinx.ext.napoleon import Config, GoogleDocstring
from sphinx.transforms.post_transforms import SphinxPostTransform
from sphinx.util.docutils import SphinxDirective
from sphinx.writers.html5 import HTML5Translator

HERE = Path(__file__).parent
ROOT = HERE.parent
sys.path[:0] = [str(ROOT), str(HERE)]
os.environ["COLUMNS"] = "96"  # Width of what commands print.

import pictures  # noqa: E402
import theory_figures  # noqa: E402

import rotor  # noqa: E402
from explorer import __main__ as page_command  # noqa: E402
from explorer.export import report  # noqa: E402
from rotor.__main__ import build_parser  # noqa: E402
from rotor.__main__ import main as rotor_main  # noqa: E402
from rotor.support.processes import Processes  # noqa: E402

# Nobody opens the pages that notebooks start: their workers are not needed.
Processes.warm = lambda pool: None

project = "rotor-explorer"
author = "rotor-explorer contributors"
copyright = f"2026, {author}, MIT licence"
release = version = rotor.__version__
extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.viewcode",
    "sphinx_gallery.gen_gallery",
]
exclude_patterns = ["developers", "templates", "notebooks", "_made/**/*.ipynb", "_made/**/*.py"]
suppress_warnings = ["config.cache"]
nitpicky = False
default_role = "code"

html_theme = "furo"
html_title = "Rotor explorer"
html_favicon = "style/favicon.svg"
html_show_sourcelink = html_copy_source = False
html_static_path = ["style"]
html_css_files = ["site.css"]
html_math_renderer = "mathml"
templates_path = ["templates"]

myst_enable_extensions = ["colon_fence", "dollarmath"]
myst_heading_anchors = 3
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_preserve_defaults = False  # `takes` adds keywords that the source of a function has not.
add_module_names = False
python_maximum_signature_line_length = 88


def clear_figures(_settings: dict, _file: str):
    """Figures of notebooks without ground, in a grey that can be read on the light page and on the dark one."""
    grey = (
        "text.color",
        "axes.labelcolor",
        "axes.titlecolor",
        "axes.edgecolor",
        "xtick.color",
        "ytick.color",
    )
    matplotlib.rcParams.update(
        {"savefig.transparent": True, "legend.framealpha": 0.0, **dict.fromkeys(grey, "#7b7b7b")}
    )


sphinx_gallery_conf = {
    "reset_modules": ("matplotlib", clear_figures),
    "examples_dirs": "notebooks",
    "gallery_dirs": "_made/notebooks",
    "filename_pattern": r"/\d\d_",
    "within_subsection_order": "FileNameSortKey",
    "abort_on_example_error": True,
    "capture_repr": (),
    "download_all_examples": False,
    "min_reported_time": 1e9,
    "show_memory": False,
    "show_signature": False,
    "write_computation_times": False,
}


class Picture(SphinxDirective):
    """`picture`: what a function of `pictures.py` or `theory_figures.py` draws, as HTML; the body is its caption."""

    required_arguments = 1
    has_content = True

    def run(self) -> list[nodes.Node]:
        module = pictures if hasattr(pictures, self.arguments[0]) else theory_figures
        self.env.note_dependency(module.__file__)
        drawn = nodes.raw(
            "", f'<div class="drawn">{getattr(module, self.arguments[0])()}</div>', format="html"
        )
        return [drawn, *self.parse_content_to_nodes()]


class CommandOutput(SphinxDirective):
    """`command-output`: a command and what it prints, in `docs` or another folder; to start a process for each takes
    longer than most commands."""

    required_arguments = 1
    final_argument_whitespace = True
    option_spec = {"cwd": directives.unchanged}  # noqa: RUF012 - as docutils has it

    def run(self) -> list[nodes.Node]:
        command, said = self.arguments[0], io.StringIO()
        _, folder = self.env.relfn2path(self.options.get("cwd", "/"))
        words = shlex.split(command.removeprefix("python -m rotor "))
        with chdir(folder), redirect_stdout(said), redirect_stderr(said):
            code = rotor_main(words)
        text = f"$ {command}\n{said.getvalue().rstrip()}"
        if code != 0:
            raise self.error(f"exit code {code}: {text}")
        return [nodes.literal_block(text, text, language="text")]


class Commands(SphinxDirective):
    """`commands`: the help of every command, from the parsers themselves."""

    def run(self) -> list[nodes.Node]:
        (rotor_commands,) = (
            a for a in build_parser()._actions if isinstance(a, argparse._SubParsersAction)
        )
        out: list[nodes.Node] = []
        for parser in (*rotor_commands.choices.values(), page_command._parser(), report._parser()):
            text = parser.format_help()
            title = parser.prog.removeprefix("python -m ")
            section = nodes.section(
                "", nodes.title(title, title), ids=[nodes.make_id(title)], names=[title]
            )
            section += nodes.literal_block(text, text, language="text")
            out.append(section)
        return out


class InlineSvg(SphinxPostTransform):
    """SVG files are put into the page without their own colours, so that they follow its light or dark form."""

    default_priority = 8

    def run(self, **_: object):
        for node in list(self.document.findall(nodes.image)):
            if node["uri"].endswith(".svg"):
                drawn = Path(self.app.srcdir, node["uri"]).read_text(encoding="utf-8")
                drawn = re.sub("<style>.*?</style>", "", drawn)
                node.replace_self(
                    nodes.raw("", f'<span class="drawn-file">{drawn}</span>', format="html")
                )


def as_restructured_text(
    _app: Sphinx, _what: str, _name: str, _value: object, _options: object, lines: list[str]
):
    """Docstrings are plain prose: indented blocks are code, `name: what it is` in a row of lines is a list."""
    # As an extension napoleon would also take a colon in an attribute's words for its type.
    if "Parameters:" in lines:
        lines[:] = GoogleDocstring(lines, Config()).lines()
        return
    out: list[str] = []
    for line in lines:
        before = out[-1] if out else ""
        indented, inside = line.startswith("    "), before.startswith(("    ", "- "))
        if indented and not before:
            out += ["::", ""] if not any(old.startswith("    ") for old in out[-2:]) else []
        elif indented and inside and not before.startswith("    "):
            line = f"  {line.strip()}"
        elif indented and not inside:
            line = line.strip()
        elif re.match(r"[a-z_]+(, [a-z_]+)*: ", line) and (
            not before or before.startswith(("- ", "  "))
        ):
            line = f"- {line}"
        elif line and inside and not indented and not line.startswith(" "):
            line = (
                f"  {line}"
                if before.startswith("- ") and re.match(r"- [a-z_]+(, [a-z_]+)*: ", before)
                else line
            )
        out.append(line)
    lines[:] = out


def plain_defaults(
    _app: Sphinx,
    _what: str,
    _name: str,
    _value: object,
    _options: object,
    signature: str,
    back: str,
):
    """Fields with a factory: `<factory>` is no Python, and Sphinx links no type where it cannot read all."""
    return signature and signature.replace("<factory>", "..."), back


def source_links(_app: Sphinx, docname: str, content: list[str]):
    """Links to folders of the source code lead to their first file, Markdown outside is a file like any other."""

    def outside(found: re.Match[str]) -> str:
        inside = ((HERE / docname).parent / found[2]).resolve().is_relative_to(HERE)
        return found[0] if inside else f"{{download}}`{found[1]} <{found[2]}>`"

    content[0] = re.sub(r"\[`?([^\]`]+)`?\]\((\.\./[\w./]+\.md)\)", outside, content[0])
    content[0] = re.sub(r"\]\((\.\./[\w./]+)/\)", r"](\1/__init__.py)", content[0])


def mathml(self: HTML5Translator, node: nodes.math | nodes.math_block):
    self.body.append(
        convert(node.astext(), display="block" if isinstance(node, nodes.math_block) else "inline")
    )
    raise nodes.SkipNode


ASKS = re.compile(r"""(?:\ssrc=|<link[^>]*\shref=|url\(|@import\s+)["']?(?:https?:)?//[^"')\s>]+""")


def check_hosts(app: Sphinx, error: Exception | None):
    """The site must open from a disk, without a network."""
    if error is not None or app.builder.name != "html":
        return
    asks = [
        f"{path.relative_to(app.outdir)}: {found[0]}"
        for path in Path(app.outdir).rglob("*")
        if path.suffix in (".html", ".css", ".js")
        for found in ASKS.finditer(path.read_text(encoding="utf-8"))
    ]
    if asks:
        raise RuntimeError("The pages ask other hosts: " + "; ".join(asks[:5]))


def setup(app: Sphinx):
    app.add_directive("picture", Picture)
    app.add_directive("command-output", CommandOutput)
    app.add_directive("commands", Commands)
    app.add_post_transform(InlineSvg)
    app.add_html_math_renderer(
        "mathml", inline_renderers=(mathml, None), block_renderers=(mathml, None)
    )
    app.connect("autodoc-process-docstring", as_restructured_text)
    app.connect("autodoc-process-signature", plain_defaults)
    app.connect("source-read", source_links)
    app.connect("build-finished", check_hosts)
