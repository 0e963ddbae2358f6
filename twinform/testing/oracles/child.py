"""A function called in a process of its own, which may die there without harm.

Engines abort on models that they did not expect, and write to the terminal as they like.
"""

import os
import pickle
import subprocess
import sys
from collections.abc import Callable
from typing import Any, TypeVar

from twinform.child_python import python_command

Result = TypeVar("Result")


class ChildDiedError(Exception):
    """The process ended before the function came back."""


def call(function: Callable[..., Result], *arguments: Any, seconds: float | None = None) -> Result:
    """What a function of a module returns or raises; arguments and result must be picklable.

    Raises:
        ChildDiedError: the process ended, or did not within so many seconds.
    """
    command = python_command("-m", "twinform.testing.oracles.child")
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(part for part in sys.path if part)}
    question = pickle.dumps((function, arguments))
    try:
        done = subprocess.run(
            command, input=question, capture_output=True, check=False, timeout=seconds, env=environment
        )
    except subprocess.TimeoutExpired as expired:
        raise ChildDiedError(f"no answer within {seconds:g} s") from expired
    if done.returncode:
        raise ChildDiedError(f"the process ended with {done.returncode}")
    returned, answer = pickle.loads(done.stdout)  # noqa: S301 - it comes from our own process
    if returned:
        return answer
    raise answer


def _serve() -> None:
    # what engines print must not get between the answer
    answer = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    function, arguments = pickle.load(sys.stdin.buffer)  # noqa: S301 - it comes from the process that started this one
    try:
        result = (True, function(*arguments))
    except Exception as error:  # noqa: BLE001 - whatever it is, the other process raises it
        result = (False, error)
    pickle.dump(result, answer)
    answer.flush()
    # without the engines' own farewells, some of which crash
    os._exit(0)


if __name__ == "__main__":
    _serve()
