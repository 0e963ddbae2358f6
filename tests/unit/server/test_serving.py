"""Messages in a stream of bytes, and bytes that are none."""

from io import BytesIO

import pytest

from twinform.server.serving import LARGEST_MESSAGE, read_messages

GOOD = b"Content-Length: 2\r\n\r\n{}"


@pytest.mark.parametrize(
    "data",
    [
        b"content-length:2\n\n{}",
        b"Content-Type: application/vscode-jsonrpc; charset=utf-8\r\nContent-Length: 2\r\n\r\n{}",
        b"Content-Length: 9\r\nContent-Length: 2\r\n\r\n{}",
    ],
)
def test_headers_are_read_as_others_write_them(data: bytes) -> None:
    assert list(read_messages(BytesIO(data + GOOD))) == [b"{}", b"{}"]


@pytest.mark.parametrize(
    "data",
    [
        b"Content-Length: -5\r\n\r\n",
        b"Content-Length: 0\r\n\r\n",
        b"Content-Length: 1000000000000\r\n\r\n{}",
        b"Content-Length: %d\r\n\r\n{}" % (LARGEST_MESSAGE + 1),
        b"Content-Length: " + b"9" * 5_000 + b"\r\n\r\n{}",
        b"Content-Length: two\r\n\r\n{}",
        b"\r\n\r\n",
        b'{"jsonrpc": "2.0"}\n',
        b"X: " + b"a" * 2**20,
        b"\0" * 2**20,
    ],
    ids=lambda data: ascii(data[:40]),
)
def test_what_is_no_message_is_told_once_and_the_next_one_is_read(data: bytes) -> None:
    assert list(read_messages(BytesIO(data + GOOD))) == [None, b"{}"]


def test_a_length_that_is_wrong_costs_its_message_and_no_more_than_the_next() -> None:
    assert list(read_messages(BytesIO(b'Content-Length: 1\r\n\r\n{"a": 1}' + GOOD)))[-1] == b"{}"
    assert list(read_messages(BytesIO(b"Content-Length: 5\r\n\r\n{}" + GOOD + GOOD)))[-1] == b"{}"
    assert list(read_messages(BytesIO(b"Content-Length: 5\r\n\r\n{}"))) == []
