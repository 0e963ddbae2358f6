"""Canonical MJCF: the tree of a file in which every element says all of itself.

MuJoCo makes the same model of it as of the file. There are no classes, frames, replicates and attached models in it;
angles are in radians, orientations are unit quaternions, shapes have a pose and a size, ranges say whether they limit,
files are named from the folder of the main file, and each section stands once.
"""

from twinform.compiler.input.load_options import LoadOptions
from twinform.compiler.input.mjcf.attach_models import Attaching
from twinform.compiler.input.mjcf.canonical_values import write_canonical_values
from twinform.compiler.input.mjcf.check_angles import check_angles
from twinform.compiler.input.mjcf.check_bodies import check_bodies
from twinform.compiler.input.mjcf.check_references import check_frame_names, check_names, check_references
from twinform.compiler.input.mjcf.check_relations import check_relations
from twinform.compiler.input.mjcf.check_shapes import check_notations, check_shapes
from twinform.compiler.input.mjcf.compiler_settings import CompilerSettings, report_sequences, rewrite_compiler
from twinform.compiler.input.mjcf.copy_budget import CopyBudget
from twinform.compiler.input.mjcf.default_classes import DefaultClasses
from twinform.compiler.input.mjcf.element_findings import ElementFindings, numbered_copy, take_numbers_out
from twinform.compiler.input.mjcf.expand_frames import expand_frames
from twinform.compiler.input.mjcf.merge_sections import merge_sections
from twinform.compiler.input.mjcf.model_files import ModelFiles, main_file
from twinform.diagnostics.rules import INCLUDE_NOT_EXPANDED
from twinform.schemas import Context, XmlElement


def normalize(root: XmlElement, context: Context, load_options: LoadOptions) -> XmlElement | None:
    """Return a canonical copy of a tree, or None where it would be too large, which is reported.

    All is reported that is wrong with the tree and that its schema cannot say.
    """
    copy, originals = numbered_copy(root)
    findings = ElementFindings(context, originals)
    for include in copy.iter("include"):  # a text that is no file has no folder in which it could be
        message = f"nothing is known of {include.get('file', '')!r}, since this text is no file that could be beside it"
        findings.report(INCLUDE_NOT_EXPANDED, include, message)
    budget = CopyBudget.of(load_options.limits)
    attaching = Attaching(ModelFiles(load_options, main_file(context.file)), prepare, budget)
    settings = prepare(copy, findings, attaching)
    if budget.is_spent or not budget.spend_on_replicates(copy, findings):
        return None
    if settings.degrees:
        check_angles(copy, findings)
    expand_frames(copy, settings, findings, budget)
    attaching.write_keys(copy, findings)
    if budget.is_spent:
        return None
    rewrite_compiler(copy)
    check_canonical(copy, findings)
    take_numbers_out(copy)
    return copy


def check_classes(root: XmlElement, context: Context, load_options: LoadOptions) -> None:
    """Report classes that are not there, for a file that stays what it is; with includes they may be in others."""
    if next(root.iter("include"), None) is None:
        copy, originals = numbered_copy(root)
        findings = ElementFindings(context, originals)
        DefaultClasses.of(copy, findings, CopyBudget.of(load_options.limits)).merge_into(copy)


def check_written(root: XmlElement, context: Context, load_options: LoadOptions) -> None:
    """Report what MuJoCo refuses in a tree that was written, which is canonical but for its default classes."""
    copy, originals = numbered_copy(root)
    findings = ElementFindings(context, originals)
    DefaultClasses.of(copy, findings, CopyBudget.of(load_options.limits)).merge_into(copy)
    check_canonical(copy, findings)


def prepare(root: XmlElement, findings: ElementFindings, attaching: Attaching) -> CompilerSettings:
    """Make all canonical in a tree but its frames and replicates, and return the settings of its compiler."""
    settings = CompilerSettings.of(root)
    report_sequences(root, findings)
    check_frame_names(root, findings)
    DefaultClasses.of(root, findings, attaching.budget).merge_into(root)
    for section in list(root.iterchildren("default")):
        root.remove(section)
    merge_sections(root)
    check_notations(root, findings)
    write_canonical_values(root, settings, findings)
    attaching.attach_all(root, findings)
    return settings


def check_canonical(root: XmlElement, findings: ElementFindings) -> None:
    """Report what MuJoCo refuses in a canonical tree and its schema cannot say."""
    named = check_names(root, findings)
    check_references(root, named, findings)
    check_shapes(root, findings)
    check_bodies(root, findings)
    check_relations(root, named, findings)
