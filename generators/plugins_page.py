"""Makes the page of systems and sensors from their catalog."""

from collections.abc import Iterable, Iterator

from twinform.passes.plugins.add_sensor import addable, settings_of
from twinform.passes.plugins.catalog import releases, ros_message, sensors, systems
from twinform.passes.plugins.catalog_types import PluginKind, PluginParameter, SensorKind
from twinform.passes.plugins.parameters import without_parentheses
from twinform.passes.plugins.plugin_options import options_of

_INTRODUCTION = """\
# Systems and sensors of Gazebo

What `add-plugin`, `add-sensor` and `check-plugins` know. An option of `add-plugin` is written as in the first column;
one that may stand several times takes a list.
"""
_TIMES = {"1": "needed", "+": "needed, repeats", "?": "", "*": "repeats"}


def plugins_page() -> str:
    """The catalog in Markdown."""
    settings = [_settings_section(type_) for type_ in addable()]
    parts = [_INTRODUCTION, _releases_table(), "# Sensors\n", _sensors_table(), *settings, "# Systems\n"]
    return "\n".join([*parts, *(_system_section(kind) for _, kind in sorted(systems().items()))])


def _releases_table() -> str:
    rows = [
        f"| {each.name} | {each.sim} | {each.sdf} | {', '.join(each.ros) or '-'} | {'yes' if each.lts else 'no'} |"
        for each in releases().values()
    ]
    return _format_table("| release | gz-sim | SDF | ROS 2 | long support |", rows)


def _sensors_table() -> str:
    head = "| type | also called | on | systems of the world | publishes |"
    return _format_table(head, [_sensor_row(kind) for kind in sensors().values()])


def _sensor_row(kind: SensorKind) -> str:
    made = "; ".join(
        f"`{without_parentheses(each.pattern)}` {each.message} ({ros_message(each.message) or 'no ROS message'})"
        for each in kind.publishes
    )
    return (
        f"| `{kind.type}`{_describe_releases(kind.releases)} | {', '.join(kind.aliases)} | {', '.join(kind.holders)} | "
        f"{', '.join((*kind.systems, *kind.world_elements))} | {made} |"
    )


def _settings_section(type_: str) -> str:
    """The options of `add-sensor` for a kind of sensor."""
    settings = settings_of(type_)
    rows = [f"| `{option}` | {each.default or 'not set'} | {each.text} |" for option, each in settings.values.items()]
    rows += [
        f"| `{option}` | none, typical {each.typical:g} | {each.text} |" for option, each in settings.noises.items()
    ]
    lines = [
        f"## sensor {type_}",
        "",
        f"`add-sensor{{type={type_}}}`: called `{settings.name}`, {settings.rate:g} Hz.",
        "",
    ]
    return "\n".join(
        [*lines, _format_table("| option | where it is not given | what it is |", rows)] if rows else lines
    )


def _system_section(kind: PluginKind) -> str:
    lines = [
        f"## system {kind.name}",
        "",
        f"`{kind.file}`, `{kind.class_name}`, in a {' or '.join(kind.scopes)}{_describe_releases(kind.releases)}.",
        "",
    ]
    rows = [_option_row(option, path, row, kind) for option, (path, row) in _option_families(kind)]
    if rows:
        lines.append(_format_table("| option | parameter | type | default | how often |", rows))
    for channel in kind.channels:
        verb = "reads" if channel.direction == ">" else "writes"
        renamed = f", or `{channel.parameter}`" if channel.parameter else ""
        since = _describe_releases(channel.releases & kind.releases, kind.releases)
        lines.append(f"It {verb} {channel.message} on `{without_parentheses(channel.pattern)}`{renamed}{since}.\n")
    return "\n".join(lines)


def _option_families(kind: PluginKind) -> Iterator[tuple[str, tuple[tuple[str, ...], PluginParameter]]]:
    """The options, of a family of names only the first."""
    seen: set[str] = set()
    for option, (path, row) in options_of(kind).items():
        if row.name not in seen or "[" not in row.name:
            yield option, (path, row)
        seen.add(row.name)


def _option_row(option: str, path: tuple[str, ...], row: PluginParameter, kind: PluginKind) -> str:
    shown = "/".join((*path[:-1], row.name))
    choices = f": {', '.join(row.choices)}" if row.choices else ""
    default = f"`{row.default}`" if row.default is not None else ""
    unit = f", {' or '.join(row.unit.split('|'))}" if row.unit else ""
    remarks = [
        _TIMES[row.count],
        _describe_needed(row),
        _describe_releases(row.releases & kind.releases, kind.releases).strip(" ()"),
    ]
    more = ", ".join(filter(None, remarks))
    dots = ", ..." if "[" in row.name else ""
    return f"| `{option}`{dots} | `{shown}` | {row.type}{choices}{unit} | {default} | {more} |"


def _describe_needed(row: PluginParameter) -> str:
    """The releases that do not work without a parameter."""
    listed = ", ".join(each for each in releases() if each in row.needed)
    if row.beside is not None:
        return f"needed with `{row.beside}`"
    return f"needed in {listed}" if listed else ""


def _describe_releases(mine: Iterable[str], all_: Iterable[str] | None = None) -> str:
    """The releases that have something, in parentheses; empty if all of them do."""
    names, everything = set(mine), list(releases())
    wanted = [each for each in everything if each in names]
    if wanted == [each for each in everything if all_ is None or each in set(all_)]:
        return ""
    return f" ({', '.join(wanted) or 'the development branch'})"


def _format_table(head: str, rows: list[str]) -> str:
    return "\n".join([head, "|" + "---|" * (head.count("|") - 1), *rows]) + "\n"
