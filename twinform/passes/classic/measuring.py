"""What plugins of Gazebo Classic took from the model, and systems want to have written."""

from twinform.ir import Element, Format, Model, Plugin
from twinform.passes.plugins.wheels import MEASURES, Measured, NotMeasuredError
from twinform.schemas import format_value


def with_measures(plugin: Plugin, system: str, model: Model, format_: Format) -> tuple[Plugin, list[str]]:
    """The plugin with the sizes that its system can read off the model, and why the others are missing."""
    written: dict[str, tuple[str, ...]] = {}
    for child in plugin.content:
        option = child.name.replace("_", "-")
        written[option] = (*written.get(option, ()), child.text or "")
    measured = Measured(model, format_, lambda option: written.get(option, ()))
    found: list[Element] = []
    missing: list[str] = []
    for name, measure in MEASURES[system].items():
        if name.replace("_", "-") in written:
            continue
        try:
            found.append(Element(name=name, text=format_value(measure(measured))))
        except NotMeasuredError as error:
            missing.append(f"it needs <{name}>, which cannot be read off the model: {error}")
    return plugin.model_copy(update={"content": (*plugin.content, *found)}), missing
