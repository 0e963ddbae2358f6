"""Reports on a model, or on two: one page of HTML that opens offline, or Markdown for a pull request.

import twinform
from twinform import report

report.show(twinform.load("robot.urdf"))  # in a notebook: the 3D view
made = report.build_report("robot.urdf", "robot.sdf")
report.html(made), report.markdown(made)
"""

from collections.abc import Callable, Mapping
from types import MappingProxyType

from twinform.report.content import ModelReport, build_report
from twinform.report.markdown import markdown
from twinform.report.notebook import Shown, show
from twinform.report.report_page import html

WRITERS: Mapping[str, Callable[[ModelReport], str]] = MappingProxyType({"html": html, "md": markdown})
"""Every form by its name on the command line."""

__all__ = ["WRITERS", "ModelReport", "Shown", "build_report", "html", "markdown", "show"]
