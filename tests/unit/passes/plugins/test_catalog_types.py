"""The notation of the tables of plugins: everything that a row can say, and where it goes."""

from twinform.passes.plugins.catalog import LATEST, releases
from twinform.passes.plugins.catalog_types import (
    Alternative,
    PluginKind,
    PluginParameter,
    Release,
    TopicChannel,
    read_plugins,
)

NAMES = ("old", "middle", "new", "main")
EVER = frozenset(NAMES)
TABLE = """# a comment is no row
system wheel-slip  file=slip.so class=gz::Slip scope=model|link

  wheel         +  element  until=new
    @link_name  1  link
    limits      *  number   any except=old|new
  mode          ?  text     default="a=b c" enum=a|b since=middle needed=old|new
  angle         ?  number   unit=rad|m
  > topic  gz.msgs.Twist  /cmd  alt=sub:/{sub}/x alt=other+more:/y:gz.msgs.Pose unless=quiet|other+more or-default
  < -      gz.msgs.Odom   /{each} when=on each=wheel/limits until=new
plugin bare  file=bare.so class=Bare scope=world any since=new
  only  1  bool
"""


def row(name: str, count: str, type_: str, **given: object) -> PluginParameter:
    usual = {
        "name": name,
        "count": count,
        "type": type_,
        "default": None,
        "choices": (),
        "free": False,
        "releases": EVER,
        "is_attribute": False,
        "children": (),
    }
    return PluginParameter(**{**usual, **given})  # pyright: ignore[reportArgumentType] - the fields of a parameter


def test_a_table_is_read_whole() -> None:
    early = EVER - {"main"}
    wheel = (
        row("@link_name", "1", "link", is_attribute=True, releases=early),
        row("limits", "*", "number", free=True, releases=frozenset({"middle"})),
    )
    slip = PluginKind(
        name="wheel-slip",
        file="slip.so",
        class_name="gz::Slip",
        scopes=("model", "link"),
        releases=EVER,
        parameters=(
            row("wheel", "+", "element", children=wheel, releases=early),
            row(
                "mode",
                "?",
                "text",
                default="a=b c",
                choices=("a", "b"),
                releases=EVER - {"old"},
                needed=frozenset({"new"}),
            ),
            row("angle", "?", "number", unit="rad|m"),
        ),
        channels=(
            TopicChannel(
                ">",
                "topic",
                "gz.msgs.Twist",
                "/cmd",
                (Alternative(("sub",), "/{sub}/x", None), Alternative(("other", "more"), "/y", "gz.msgs.Pose")),
                (("quiet",), ("other", "more")),
                (),
                (),
                EVER,
                "or-default",
            ),
            TopicChannel("<", None, "gz.msgs.Odom", "/{each}", (), (), (("on",),), ("wheel", "limits"), early),
        ),
        free=False,
    )
    late = frozenset({"new", "main"})
    bare = PluginKind("bare", "bare.so", "Bare", ("world",), late, (row("only", "1", "bool", releases=late),), (), True)
    assert list(read_plugins(TABLE, NAMES)) == [slip, bare]


def test_releases_are_read_whole() -> None:
    releases.cache_clear()
    assert releases() == {
        "fortress": Release("fortress", 6, "1.9", ("humble", "iron"), True, "ignition_frame_id"),
        "garden": Release("garden", 7, "1.10", (), False, "gz_frame_id"),
        "harmonic": Release("harmonic", 8, "1.11", ("jazzy",), True, "gz_frame_id"),
        "ionic": Release("ionic", 9, "1.12", ("kilted",), False, "frame_id"),
        "jetty": Release("jetty", 10, "1.12", ("lyrical",), True, "frame_id"),
    }
    assert LATEST not in releases()
