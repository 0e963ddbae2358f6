import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from twinform.passes.plugins.yaml_text import quote, yaml_text

TEXTS = st.text(st.characters(exclude_categories=["Cs"])) | st.sampled_from(
    ["", "yes", "No", "null", "~", "1", "1e3", "0x1", "nan", ".inf", "a: b", "- a", "a #b", " a", "2001-01-01", "🤖"]
)
KEYS = TEXTS.filter(lambda key: len(quote(key)) < 1000)
SCALARS = TEXTS | st.booleans() | st.none() | st.integers() | st.floats(allow_nan=False, allow_infinity=False)
VALUES = st.recursive(SCALARS, lambda inner: st.lists(inner) | st.dictionaries(KEYS, inner), max_leaves=12)


@pytest.mark.slow
@given(st.dictionaries(KEYS, VALUES, min_size=1))
def test_what_is_written_is_read_back(value: dict[str, object]) -> None:
    read = yaml.safe_load(yaml_text(value))  # pyright: ignore[reportArgumentType] - Hypothesis has no recursive types
    assert repr(read) == repr(value)  # 1, 1.0 and true are equal, and not the same to ROS


@given(TEXTS)
def test_quoted_text_is_text(text: str) -> None:
    assert yaml.safe_load(quote(text)) == text
    assert quote(text).isascii()


def test_it_is_pleasant_to_read() -> None:
    text = yaml_text({"node": {"names": ["a_joint", "b c"], "rate": 100, "gain": 0.5, "on": True, "none": {}, "x": []}})
    assert text == (
        'node:\n  names:\n    - a_joint\n    - b c\n  rate: 100\n  gain: 0.5\n  "on": true\n  none: {}\n  x: []\n'
    )
