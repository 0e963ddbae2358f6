"""Draws edits of a robot file at random: kinds by how often people make them, values within sense."""

from collections.abc import Callable
from random import Random

from lxml import etree

from testbed.edits import additions, arrangements, deletions, mistakes, mjcf_edits, names, values
from testbed.edits.edit import Edit, EditError
from testbed.edits.scene import Scene

Draw = Callable[[Scene, Random], Edit | None]
"""Draws an edit of one kind; None where the file has nothing that it could change."""

KINDS: tuple[tuple[int, Draw], ...] = (
    (10, values.change_number),
    (2, values.change_type),
    (1, values.change_switch),
    (1, values.change_file),
    (4, names.rename_everywhere),
    (2, names.rename_outside_carriers),
    (2, names.point_elsewhere),
    (2, names.hang_elsewhere),
    (4, deletions.delete_part),
    (3, deletions.delete_value),
    (1, deletions.delete_attribute),
    (1, deletions.delete_limit),
    (2, deletions.delete_link),
    (2, deletions.delete_carrier),
    (1, deletions.delete_carriers),
    (1, deletions.delete_our_attribute),
    (2, values.change_carried_number),
    (1, arrangements.duplicate_carrier),
    (3, additions.add_part),
    (1, additions.add_inertial),
    (3, additions.add_gazebo),
    (2, additions.add_frame),
    (3, additions.add_link),
    (2, additions.add_to_joint),
    (1, additions.add_transmission),
    (2, arrangements.reorder),
    (2, arrangements.move_shape),
    (2, arrangements.duplicate),
    (1, arrangements.say_nothing),
    (1, mistakes.make_a_mistake),
)
"""How often each kind is drawn in URDF and SDF, and what draws it."""
KINDS_OF_MJCF: tuple[tuple[int, Draw], ...] = (
    (10, values.change_number),
    (2, mjcf_edits.change_type),
    (5, mjcf_edits.rename_part),
    (2, names.point_elsewhere),
    (2, mjcf_edits.hang_elsewhere),
    (3, deletions.delete_part),
    (2, deletions.delete_value),
    (3, deletions.delete_attribute),
    (1, mjcf_edits.delete_limit),
    (2, mjcf_edits.delete_link),
    (2, deletions.delete_carrier),
    (1, deletions.delete_carriers),
    (2, values.change_carried_number),
    (3, mjcf_edits.add_part),
    (3, mjcf_edits.add_body),
    (3, mjcf_edits.add_to_joint),
    (2, mjcf_edits.add_relation),
    (2, arrangements.reorder),
    (2, arrangements.move_shape),
    (2, arrangements.duplicate),
    (1, arrangements.say_nothing),
    (1, mistakes.make_a_mistake),
)
"""The kinds of MJCF: those of the others that fit it, and its own."""
MOST = 3
_TRIES = 20


def draw_edits(text: bytes, random: Random, *, most: int = MOST) -> tuple[tuple[Edit, ...], bytes]:
    """One edit or a few, and the text of the file after them."""
    count = 1 if most == 1 or random.random() < 0.6 else random.randint(2, most)
    edits: list[Edit] = []
    for _ in range(count):
        edit, text = draw_edit(text, random)
        edits.append(edit)
        if edit.kind == mistakes.KIND:  # what comes after it might put it right
            break
    return tuple(edits), text


def draw_edit(text: bytes, random: Random) -> tuple[Edit, bytes]:
    """An edit of a file, and its text after it."""
    scene = Scene(etree.fromstring(text))
    weights, draws = zip(*(KINDS_OF_MJCF if scene.is_mjcf else KINDS), strict=True)
    for _ in range(_TRIES):
        (draw,) = random.choices(draws, weights)
        edit = draw(scene, random)
        if edit is None:
            continue
        try:
            return edit, edit.apply(text)
        except EditError:  # a prefix that means two things in one file hides an element from its path
            continue
    edit = arrangements.say_nothing(scene, random)
    return edit, edit.apply(text)
