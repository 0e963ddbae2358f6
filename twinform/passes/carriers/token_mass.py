"""Token mass for massless links, so that the physics engines of Gazebo can move them."""

from twinform.ir import Inertia, Inertial, Model
from twinform.passes.carriers.annotations import find_annotation, without_annotation
from twinform.passes.carriers.carriers import is_ours

# Below what any comparison here looks at (1e-9), ten times what MuJoCo asks for. Of 69 corpus
# robots on which DART aborts with a mass of zero (gz-physics 5), all come through with this at
# rest, with joints started at 0.5 rad/s, and with velocities commanded. With a torque of 1 N m on
# each joint a fifth of them still ends in NaN, where 1e-3 kg would hold; but 1e-3 kg would be
# another robot.
TOKEN_MASS = 1e-12
"""In kg: DART aborts on a body that moves and has none, Bullet holds it where it is."""
TOKEN_MOMENT = 1e-14
"""In kg m^2, about each axis: ten times the least that MuJoCo takes."""
# Measured in DART on a universal joint: with 2e-6 kg and the moments of the token the link below
# moves as in SDF to 1e-15 rad; with 1e-12 kg m^2 to 6e-14, with 1e-9 to 6e-11, and with 1e-3 kg and
# 1e-6 kg m^2 to 6e-8. In Drake, a robot with chains agrees to 2e-5, and to 1e-9 once the tokens are
# taken out (tests/oracles/test_drake_chains.py).
CHAIN_MASS = 2e-6
"""In kg, of a link in a chain of URDF: libsdformat before 12.7.2 leaves out what weighs 1e-6 kg or less, and all below.

That is `CreateSDF` of parser_urdf.cc, where a mass equals 0.0 by the tolerance of gz-math.
"""
UNSAID = "unsaid"
"""The annotation on an SDF inertial that lists what URDF leaves out: `<tf:unsaid>inertia</tf:unsaid>`, or `inertial`.

Where URDF has zero, and a token stands in SDF, it is `zero-mass` and `zero-inertia`.
"""
TOKEN = Inertial.unchecked(
    mass=TOKEN_MASS,
    inertia=Inertia.unchecked(ixx=TOKEN_MOMENT, ixy=0.0, ixz=0.0, iyy=TOKEN_MOMENT, iyz=0.0, izz=TOKEN_MOMENT),
)
CHAIN_TOKEN = TOKEN.copy(mass=CHAIN_MASS)
_ZERO = Inertial.unchecked(mass=0.0, inertia=Inertia.unchecked(ixx=0.0, ixy=0.0, ixz=0.0, iyy=0.0, iyz=0.0, izz=0.0))
MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


def without_tokens(model: Model) -> Model:
    """The model with nothing where links have a token: what is weighed and compared."""
    links = tuple(link.copy(inertial=_without_token(link.inertial)) if link.inertial else link for link in model.links)
    models = tuple(map(without_tokens, model.models))
    return model.copy(links=links, models=models)


def _without_token(inertial: Inertial) -> Inertial:
    update: dict[str, object] = {}
    if has_token_mass(inertial) or is_chain_token(inertial):
        update["mass"] = 0.0
    if inertial.inertia is not None:
        tokens = [name for name in MOMENTS if getattr(inertial.inertia, name) == TOKEN_MOMENT]
        update["inertia"] = inertial.inertia.copy(**dict.fromkeys(tokens, 0.0))
    return inertial.copy(**update) if update else inertial


def has_token_mass(inertial: Inertial) -> bool:
    """Whether the mass is the token."""
    return inertial.mass == TOKEN_MASS


def has_token_inertia(inertial: Inertial) -> bool:
    """Whether the inertia is the token."""
    # a product of inertia that is not written is zero
    return inertial.inertia is not None and all(
        (getattr(inertial.inertia, name) or 0.0) == getattr(TOKEN.inertia, name) for name in MOMENTS
    )


def is_token(inertial: Inertial | None) -> bool:
    """Whether an inertial has the token at the origin of its link, and no more."""
    return inertial is not None and has_token_mass(inertial) and _is_empty_besides(inertial)


def is_chain_token(inertial: Inertial | None) -> bool:
    """Whether an inertial is that of a link in a chain, at the origin of its link, and no more."""
    return inertial is not None and inertial.mass == CHAIN_MASS and _is_empty_besides(inertial)


def _is_empty_besides(inertial: Inertial) -> bool:
    return inertial.pose is None and all(map(is_ours, inertial.opaque)) and has_token_inertia(inertial)


def restore_inertial(inertial: Inertial) -> Inertial:
    """The inertial without the masses and moments that an annotation says its source left out, or has as zero."""
    found = find_annotation(inertial, UNSAID)
    if found is None:
        return inertial
    names = (found.text or "").split()
    inertial = without_annotation(inertial, UNSAID)
    if "inertial" in names:
        return _ZERO.copy(opaque=inertial.opaque) if is_token(inertial) else inertial
    update: dict[str, object] = {}
    if "mass" in names and (not inertial.mass or has_token_mass(inertial)):
        update["mass"] = None
    if "zero-mass" in names and has_token_mass(inertial):
        update["mass"] = 0.0
    if "inertia" in names and (not any(moments(inertial)) or has_token_inertia(inertial)):
        update["inertia"] = None
    if "zero-inertia" in names and has_token_inertia(inertial):
        update["inertia"] = _ZERO.inertia
    return inertial.copy(**update)


def says_zero(inertial: Inertial) -> bool:
    """Whether an annotation says that the mass is zero in the source, and not only left out."""
    found = find_annotation(inertial, UNSAID)
    return found is not None and "zero-mass" in (found.text or "").split()


def moments(inertial: Inertial) -> list[float | None]:
    """The moments and products of inertia as they are written; none without an inertia."""
    return [getattr(inertial.inertia, name) for name in MOMENTS] if inertial.inertia else []
