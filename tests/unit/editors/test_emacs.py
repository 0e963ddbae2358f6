"""The settings for Emacs, in a real one with eglot."""

from pathlib import Path

import pytest

from testbed.editor.emacs import answers, missing

pytestmark = pytest.mark.slow


@pytest.fixture(autouse=True)
def installed() -> None:
    if missing():
        pytest.skip(missing())


def test_a_file_has_findings_completion_and_closing_tags(tmp_path: Path) -> None:
    file = tmp_path / "arm.urdf"
    file.write_text('<robot name="r">\n  <link name="base"/>\n  <link name="base"/>\n\n</robot>\n', encoding="utf-8")
    script = """
      (message "ANSWER %s" major-mode)
      (flymake-mode 1) (flymake-start)
      (wait-for #'flymake-diagnostics)
      (message "ANSWER %s" (replace-regexp-in-string "\\n" " " (flymake-diagnostic-text (car (flymake-diagnostics)))))
      (goto-char (point-min)) (forward-line 3)
      (type "<joint name=\\"j\\" type=\\"\\">")
      (message "ANSWER %s" (buffer-substring (line-beginning-position) (line-end-position)))
      (search-backward "\\"\\">") (forward-char 1)
      (let ((found (eglot-completion-at-point)))
        (message "ANSWER %s" (member "revolute" (mapcar #'substring-no-properties
                                                        (all-completions "" (nth 2 found))))))
    """
    mode, finding, line, offered = answers(file, script)
    assert mode == "urdf-mode"
    assert "base" in finding
    assert line == '<joint name="j" type=""></joint>'
    assert "revolute" in offered
