"""Bytes to text and back, in every encoding that a model may have."""

import pytest

from twinform.text import SourceText, UndecodableError

TEXT = '<?xml version="1.0"?>\r\n<robot name="ü"/>\r\n'


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be"])
def test_bytes_come_back(encoding: str) -> None:
    data = TEXT.encode(encoding)
    source = SourceText.of(data)
    assert (source.text, source.data, source.line_end) == (TEXT, data, "\r\n")


def test_a_declared_encoding_counts() -> None:
    data = b"<?xml version='1.0' encoding='ISO-8859-1'?>\n<robot name='\xfc'/>"
    source = SourceText.of(data)
    assert source.text.endswith("<robot name='ü'/>")
    assert source.data == data
    assert source.with_text("<robot name='☃ü'/>").data == b"<robot name='&#9731;\xfc'/>"


@pytest.mark.parametrize("data", [b"\xff\xfe\x00", b"<a b='\xfc'/>", b"<?xml version='1.0' encoding='none'?><a/>"])
def test_what_cannot_be_decoded(data: bytes) -> None:
    with pytest.raises(UndecodableError):
        SourceText.of(data)
