"""Robots by their names in the package robot_descriptions, which fetches them from their repositories."""

from importlib import import_module
from typing import Unpack

from twinform.compiler.input.load_options import FileOptions
from twinform.compiler.input.loading import load
from twinform.diagnostics import did_you_mean
from twinform.ir import Document


def load_description(name: str, **options: Unpack[FileOptions]) -> Document:
    """Read the document of a robot by its name in the package robot_descriptions.

    That package, which the extra `descriptions` brings, clones the repository of a robot with git when it is first
    asked for. Arguments and folders that are given go before those of the description.

    Example:
        >>> robot = twinform.load_description("ur5e_description")  # doctest: +SKIP

    Args:
        name: The name of the description, such as `ur5e_description`.

    Keyword Args:
        strict: Refuse what readers ignore, such as unknown names.
        engine: The XSD validator; xmlschema is the slow reference.
        paths: A folder of models or packages, looked in before those that the environment names; repeatable.
        env: An environment variable that xacro files may read besides those of ROS and Gazebo; * fits any letters.
        xacro: Expand all files, or none; by default those called .xacro, .xacro.urdf or .xacro.sdf.
        max_size: The largest file that is read, such as 200MB or 1GiB; by default 64MiB.
        max_tags: The most tags of a file, or parts of a JSON document; by default 1,000,000.
        arguments: The arguments of xacro files, by their names.

    Raises:
        CompileError: the file has an error; what was found is in its diagnostics.
        ModuleNotFoundError: robot_descriptions is not installed.
        TypeError: there is no such option.
        ValueError: there is no such description, or it is neither URDF nor xacro.
    """
    try:
        known = import_module("robot_descriptions").DESCRIPTIONS
    except ImportError as error:
        from twinform.installation import install_command  # noqa: PLC0415 - most have what they need

        message = f"robot_descriptions is not installed; run: {install_command('descriptions')}"
        raise ModuleNotFoundError(message, name="robot_descriptions") from error
    if name not in known:
        raise ValueError(f"robot_descriptions has no {name!r}; {did_you_mean(name, known) or 'it lists its own'}")
    if not known[name].has_urdf:
        raise ValueError(f"{name!r} is not URDF; a name that ends in '_description' without '_mj' mostly is")
    found = import_module(f"robot_descriptions.{name}")
    arguments = {**getattr(found, "XACRO_ARGS", {}), **(options.get("arguments") or {})}
    others = getattr(found, "XACRO_PACKAGE_PATHS", {}).values()
    paths = (*(options.get("paths") or ()), found.PACKAGE_PATH, found.REPOSITORY_PATH, *others)
    path = getattr(found, "URDF_PATH", None) or found.XACRO_PATH
    return load(path, **{**options, "arguments": arguments, "paths": paths})
