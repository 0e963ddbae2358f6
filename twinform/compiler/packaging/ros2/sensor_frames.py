"""The frames of sensors in a package: those that they lack are made, and those that tf does not have are reported."""

from collections import Counter, defaultdict
from collections.abc import Iterable
from typing import ClassVar

from pydantic import Field

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Document, Model, Sensor, rewrite
from twinform.passes.framework.pass_base import Pass
from twinform.passes.plugins.add_elements import add_own_frame, frames_of, is_placed, own_frame_name, set_frame_id
from twinform.passes.plugins.catalog import release
from twinform.passes.plugins.release_names import ReleaseName
from twinform.passes.plugins.sites import PluginSite, map_sensors, sensors_of
from twinform.passes.plugins.world_systems import kind_of_sensor


class NameSensorFrames(Pass):
    """Give each sensor that names no frame the one of its link, or a frame where it is.

    Changes: sensors on links that Gazebo simulates; the model gets a frame, in URDF a link, for those with a pose of
    their own, and for cameras one that looks along z as images of ROS do.
    Never touches: frames that a sensor names, and sensors on joints.
    """

    name: ClassVar[str] = "name-sensor-frames"

    release: ReleaseName = Field(default="harmonic", description="The release of Gazebo that runs the model.")

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with frames for all sensors on links."""
        added: dict[str, list[tuple[str, Sensor, str, str]]] = defaultdict(list)
        often = Counter(sensor.name for sensor, _ in sensors_of(document))

        def change(sensor: Sensor, site: PluginSite) -> Iterable[Sensor]:
            kind = kind_of_sensor(sensor, self.release)
            link = site.link_or_joint
            if kind is None or site.scope != "link" or link is None or site.model is None or any(frames_of(sensor)):
                return (sensor,)
            own = own_frame_name(site.model, sensor, kind.type)
            if own is not None:
                own = f"{link}_{own}" if often[sensor.name] > 1 else own
                added[site.model.name].append((own, sensor, kind.type, link))
            return (set_frame_id(sensor, own or link, self.release),)

        def with_frames(model: Model) -> Model:
            for own, sensor, type_, link in added.get(model.name, ()):
                model = add_own_frame(model, own, sensor, type_, link, document.format)
            return model

        named = map_sensors(document, change)
        return rewrite(named, Model, with_frames) if added else named


def report_frames(document: Document, gazebo: str, sink: DiagnosticSink) -> None:
    """Report each sensor that Gazebo simulates and that names no frame, or that of its link and is elsewhere."""
    for sensor, site in sensors_of(document):
        if kind_of_sensor(sensor, gazebo) is None or site.model is None:
            continue
        named = list(frames_of(sensor))
        if not named:
            _report_nameless(sensor, site, gazebo, sink)
        elif site.scope == "link" and site.link_or_joint in named and is_placed(sensor):
            message = f"messages of sensor {sensor.name!r} are in the frame of link {site.link_or_joint!r}, "
            message += "and the sensor has a pose of its own on it"
            help_ = "leave the frame out, and the package has a link where the sensor is"
            sink.report(rules.FRAME_ELSEWHERE, message, sensor.location, found=site.link_or_joint, help=help_)


def _report_nameless(sensor: Sensor, site: PluginSite, gazebo: str, sink: DiagnosticSink) -> None:
    model = site.model.name if site.model else None
    frame = "/".join(filter(None, (model, site.link_or_joint, sensor.name)))
    message = f"messages of sensor {sensor.name!r} are in the frame {frame!r}, which tf does not have"
    element = release(gazebo).frame_element
    help_ = f"write the link that it measures in into it: <{element}>LINK</{element}>"
    sink.report(rules.FRAME_NOT_IN_TF, message, sensor.location, found=frame, help=help_)
