"""The environment variables that a xacro file may read: all but secrets, as far as a name or a value shows them."""

import re
from collections.abc import Mapping

from twinform.compiler.input.xacro.files import OutsideError

_WORDS = frozenset({"auth", "cert", "cookie", "dsn", "jwt", "key", "keys", "login", "pass", "pat", "private", "pwd"})
"""Parts of a name, between underscores, that make the variable a secret."""
_PARTS = ("apikey", "authorization", "credential", "passphrase", "passwd", "password", "secret", "session", "token")
"""Letters that make a secret of it anywhere in its name."""
_FOLDERS = frozenset({"PWD", "OLDPWD"})
_PASSWORD = re.compile(r"://[^/\s:]*+:[^/\s@]*+@")
"""A user's password in a URL."""


def variable(name: str, environment: Mapping[str, str]) -> str | None:
    """The value of an environment variable; None where there is none.

    Raises:
        OutsideError: by its name it is a secret, or there is a password in it.
    """
    value = environment.get(name)
    if _is_secret(name) or (value is not None and _PASSWORD.search(value)):
        message = f"the environment variable {name!r} is not given to a xacro file: it may be a secret"
        raise OutsideError(message, f"give it as an argument, {name.lower()}:=..., and use $(arg {name.lower()})")
    return value


def _is_secret(name: str) -> bool:
    lower = name.lower()
    words = re.split(r"[^a-z]+", lower)
    return name not in _FOLDERS and (bool(_WORDS.intersection(words)) or any(part in lower for part in _PARTS))
