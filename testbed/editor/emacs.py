"""A real Emacs with eglot and the settings of editors/README.md, in batch mode: it evaluates a script in a file."""

import json
import re
import shutil
import subprocess
import sys
from functools import cache
from pathlib import Path

from testbed.corpus.files import ROOT

PROGRAM = shutil.which("emacs")
_SECONDS = 60


@cache
def missing() -> str:
    """Say what is missing for these tests; empty if nothing is."""
    if PROGRAM is None:
        return "Emacs is not installed: apt-get install emacs-nox elpa-eglot"
    done = _run(PROGRAM, "(require 'eglot)")
    return "" if done.returncode == 0 else "eglot is not installed: apt-get install elpa-eglot"


def settings() -> str:
    """The settings that the page of editors tells people to write, with the server of this Python."""
    text = (ROOT / "editors" / "README.md").read_text(encoding="utf-8")
    block = re.search(r"```elisp\n(.*?)```", text, re.DOTALL)
    assert block is not None
    command = " ".join(json.dumps(each) for each in (sys.executable, "-m", "twinform", "lsp"))
    made = block[1].replace('"twinform" "lsp"', command)
    assert made != block[1]
    # what runs behind a key of a person does not run in batch mode
    return made.replace("#'eglot-ensure", "#'ignore")


def answers(file: Path, script: str) -> list[str]:
    """Open a file, attach the server, evaluate a script, and return what it says with `(message "ANSWER %s" ...)`."""
    assert PROGRAM is not None
    program = f"""(progn {settings()}
      (require 'eglot)
      (setq eglot-sync-connect t)
      (find-file {json.dumps(str(file))})
      (apply #'eglot--connect (eglot--guess-contact))
      (defun wait-for (is-done)
        (let ((end (+ (float-time) {_SECONDS / 2})))
          (while (and (not (funcall is-done)) (< (float-time) end)) (accept-process-output nil 0.05))))
      (defun type (text) (dolist (key (string-to-list text))
        (let ((last-command-event key) (last-input-event key)) (call-interactively #'self-insert-command))))
      {script}
      (eglot-shutdown (eglot-current-server)))"""
    done = _run(PROGRAM, program)
    assert done.returncode == 0, done.stderr
    return re.findall(r"^ANSWER (.*)$", done.stderr, re.MULTILINE)


def _run(program: str, expression: str) -> subprocess.CompletedProcess[str]:
    command = [program, "--batch", "--eval", expression]
    return subprocess.run(command, capture_output=True, text=True, timeout=_SECONDS, check=False)
