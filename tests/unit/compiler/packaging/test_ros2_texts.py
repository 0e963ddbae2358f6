import ast
import shutil
import subprocess
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from twinform.compiler.packaging.ros2_texts import cmake_text, python_text, render

HOSTILE = ("a b", 'a"b', "a;b", "${a}", "$ENV{HOME}", "@a@", "a\\b", ")", "#", "a\nb", "[[a]]")


@pytest.mark.slow
@given(st.text())
def test_python_text_is_the_text(text: str) -> None:
    assert ast.literal_eval(python_text(text)) == text
    assert python_text(text).isascii()


@pytest.mark.parametrize("text", ["plain", "model-1_9.sdf"])
def test_plain_text_needs_no_quotes_in_cmake(text: str) -> None:
    assert cmake_text(text) == text


@pytest.mark.skipif(shutil.which("cmake") is None, reason="cmake is not installed")
def test_cmake_reads_the_text(tmp_path: Path) -> None:
    lines = [f'file(WRITE "{tmp_path}/{number}" {cmake_text(text)})' for number, text in enumerate(HOSTILE)]
    script = tmp_path / "script.cmake"
    script.write_text("\n".join(lines), encoding="utf-8")
    subprocess.run(["cmake", "-P", script], check=True)
    assert tuple((tmp_path / str(number)).read_text(encoding="utf-8") for number in range(len(HOSTILE))) == HOSTILE


def test_what_is_put_in_is_not_looked_at_again() -> None:
    text = render("gazebo_resource_path.dsv.in", {"variable": "{{variable}}  #? fact"}, {})
    assert text == "prepend-non-duplicate;{{variable}}  #? fact;share\n"
