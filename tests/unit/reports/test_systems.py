"""The readers of C++ behind the report on systems: the patterns that they read elements with, on our own snippets."""

from pathlib import Path

import pytest

from reports.harness.sample import Sample
from reports.who_reads_it.catalog_differences import of_system, of_systems
from reports.who_reads_it.cpp_source import Scope, arguments, without_comments
from reports.who_reads_it.sensor_sources import read_sensor, suffixes_in
from reports.who_reads_it.system_sources import Read, SystemSource, read_system, systems_in
from reports.who_reads_it.systems import checkout, differences, measure
from twinform.passes.plugins.catalog import system

READINGS: dict[str, tuple[str, dict[str, Read]]] = {
    "a default in the call": ('auto a = _sdf->Get<double>("rate", 10).first;', {"rate": Read({"number"}, {"10"})}),
    "a default in the call that fills a variable": (
        '_sdf->Get<bool>("off", this->off, false);',
        {"off": Read({"bool"}, {"false"})},
    ),
    "a member's initializer": (
        'struct D { double gain{2.5}; };  if (_sdf->HasElement("g")) this->d->gain = _sdf->Get<double>("g");',
        {"g": Read({"number"}, {"2.5"}, {"element"})},
    ),
    "a member's value behind an equals sign": (
        'public: int count = 3;\n this->count = _sdf->Get<int>("n", this->count).first;',
        {"n": Read({"integer"}, {"3"})},
    ),
    "the last variable of the name before": (
        'double p = 9; } { double p = 1; if (x) { p = e->Get<double>("p"); }',
        {"p": Read({"number"}, {"1"})},
    ),
    "a value that is assigned before": (
        'int dims; this->d.dims = 2; if (y) { this->d.dims = _sdf->Get<int>("dims"); }',
        {"dims": Read({"integer"}, {"2"})},
    ),
    "a constant": (
        'constexpr double kMost = 1.5 / 3; x = _sdf->Get<double>("most", kMost).first;',
        {"most": Read({"number"}, {"0.5"})},
    ),
    "half a turn": (
        'double stall = GZ_PI_2; void f() { this->stall = _sdf->Get<double>("s", this->stall).first; }',
        {"s": Read({"number"}, {"1.57079632679"})},
    ),
    "a vector": (
        'math::Vector3d up{0, 0, 1.0}; void f() { up = _sdf->Get<math::Vector3d>("up", up).first; }',
        {"up": Read({"vector"}, {"0 0 1"})},
    ),
    "a vector with a name": (
        'v = _sdf->Get<gz::math::Vector3d>("v", math::Vector3d::One).first;',
        {"v": Read({"vector"}, {"1 1 1"})},
    ),
    "a text": ('auto f = _sdf->Get<std::string>("prefix", "door_").first;', {"prefix": Read({"text"}, {"door_"})}),
    "a text that is put together is no default": (
        'auto t = _sdf->Get<std::string>("topic", base + "/cmd").first;',
        {"topic": Read({"text"})},
    ),
    "a local variable has no default": ('const double low = _sdf->Get<double>("low");', {"low": Read({"number"})}),
    "an element's own value": (
        'auto n = _sdf->GetElement("n")->Get<int>();',
        {"n": Read({"integer"}, set(), {"element"})},
    ),
    "an element that repeats": (
        'auto e = _sdf->FindElement("j"); e = e->GetNextElement("j");',
        {"j": Read(places={"element"})},
    ),
    "an attribute": ('if (e->HasAttribute("kind")) k = e->GetAttribute("kind");', {"kind": Read(places={"attribute"})}),
    "a name in a constant": (
        'const std::string kTag = "label"; int l = _sdf->Get<int>(kTag);',
        {"label": Read({"integer"})},
    ),
    "a name that is compared": ('while (e) if (e->GetName() == "layer") f();', {"layer": Read(places={"element"})}),
    "a helper": ('d = SdfParam(_sdf, "density", 1.225);', {"density": Read(set(), {"1.225"})}),
    "a helper with a type": ('v = Parse<double>(_sdf, "p_gain");', {"p_gain": Read({"number"})}),
    "a call over lines": ('x = _sdf->Get<double>(\n    "wide",\n    4.0).first;', {"wide": Read({"number"}, {"4"})}),
    "a comment reads nothing": ('// _sdf->Get<int>("no")\n/* _sdf->HasElement("no") */', {}),
    "what is not SDF reads nothing": ('map.at("no"); f("no"); x = y.Get(no, 1);', {}),
}


@pytest.mark.parametrize("name", READINGS)
def test_a_reading_is_found_with_its_type_and_default(name: str) -> None:
    text, expected = READINGS[name]
    assert read_system(without_comments(text)).parameters == expected


def test_a_default_may_stand_in_the_header() -> None:
    found = read_system('this->rate = _sdf->Get<double>("rate", this->rate).first;', "class A { double rate = 7; };")
    assert found.parameters == {"rate": Read({"number"}, {"7"})}


def test_names_that_stand_for_each_other_end() -> None:
    assert Scope(("double a = b; double b = a;",), 99).value("a") is None
    assert Scope(("",), 0).value("f(g(1, 2), 3)") is None


def test_arguments_are_split_outside_of_brackets_and_texts() -> None:
    assert arguments('f("a,)", g(1, 2), {3, 4})', 1) == (['"a,)"', "g(1, 2)", "{3, 4}"], 25)
    assert arguments("f(", 1)[0] == []


def test_topics_and_messages_are_found() -> None:
    found = read_system("""
        #include "gz/msgs/other.pb.h"
        auto t = "/model/" + name + "/cmd_vel"; auto f = "a.txt"; auto u = "https://x.org/y z";
        node.Subscribe(t, &Drive::OnCmd, this);
        pub = node.Advertise<gz::msgs::Odometry>(t);
        void Drive::OnCmd(const msgs::Twist &_msg) {}
    """)
    assert {"model", "cmd_vel"} <= found.topics
    assert not found.topics & {"other", "a.txt", "x.org"}
    assert found.messages == {"Twist", "Odometry"}


def test_sensors_have_suffixes_topics_and_messages() -> None:
    assert suffixes_in('const std::string gpuLidarSuffix{"/scan"}; std::string rgbdCameraSuffix{""};') == {
        "gpuLidar": "scan",
        "rgbdCamera": "",
    }
    found = read_sensor(
        'this->SetTopic("/camera"); p = n.Advertise<msgs::Image>(this->Topic() + "/left"); this->AdvertiseInfo();'
    )
    assert found.topics == {"left", "camera_info"}
    assert found.messages == {"Image", "CameraInfo"}


def _judged(**parameters: Read) -> set[tuple[str, str, str, str]]:
    source = SystemSource(parameters, frozenset({"model", "cmd_force"}), frozenset({"Double"}))
    return {(each.kind, each.what, each.here, each.there) for each in of_system(SYSTEM, source, "harmonic")}


SYSTEM = system("apply-joint-force")


def test_what_the_catalog_has_right_is_no_difference() -> None:
    assert _judged(joint_name=Read({"text"})) == set()


def test_what_differs_is_reported() -> None:
    assert _judged() == {("unread", "joint_name", "joint", "")}
    assert _judged(joint_name=Read(places={"attribute"})) == {("place", "joint_name", "element", "attribute")}
    assert _judged(joint_name=Read({"number"}, {"1"}), gain=Read({"number"})) == {
        ("type", "joint_name", "text", "number"),
        ("default", "joint_name", "", "1"),
        ("lacks", "gain", "", "number"),
    }
    source = SystemSource({"joint_name": Read()}, frozenset({"cmd"}), frozenset())
    assert {each.key for each in of_system(SYSTEM, source, "harmonic")} == {
        "apply-joint-force topic cmd",
        "apply-joint-force topic cmd_force",
        "apply-joint-force message Double",
    }


def test_systems_that_only_one_side_has_are_reported() -> None:
    found = {each.key for each in of_systems({"Newest": SystemSource({}, frozenset(), frozenset())}, "harmonic")}
    assert "Newest system not in the catalog" in found
    assert "imu system not in the source" in found
    assert "cpu-lidar system not in the source" not in found


def _checkout(folder: Path, text: str) -> Path:
    (folder / "src/systems/mine").mkdir(parents=True)
    (folder / "CMakeLists.txt").write_text("project(gz-sim8 VERSION 8.1.2)\n")
    (folder / "src/systems/mine/Mine.cc").write_text(text)
    (folder / "src/systems/mine/Mine.hh").write_text("double rate = 4;")
    (folder / "src/systems/mine/Mine_TEST.cc").write_text('_sdf->HasElement("tested")')
    return folder


def test_a_checkout_is_read_by_the_names_that_files_use(tmp_path: Path) -> None:
    text = """this->rate = _sdf->Get<double>("rate", this->rate).first;
    GZ_ADD_PLUGIN(MinePlugin, System)
    GZ_ADD_PLUGIN_ALIAS(MinePlugin, "gz::sim::systems::Mine")"""
    found = systems_in(_checkout(tmp_path, text))
    assert found["Mine"].parameters == {"rate": Read({"number"}, {"4"})}
    assert differences([checkout(tmp_path)]).keys() == {"harmonic"}


def test_without_sources_and_with_a_wrong_path_it_reports_so(tmp_path: Path) -> None:
    with pytest.raises(SystemExit, match="no sources"):
        measure(Sample())
    with pytest.raises(SystemExit, match="no checkout"):
        measure(Sample(inputs=(str(tmp_path),)))
