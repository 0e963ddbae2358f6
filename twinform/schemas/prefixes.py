"""Words that other readers have under a prefix of their own, by which they know them; few files declare it."""

from twinform.schemas.xml import XmlElement, prefix_of

_DRAKE = """
    acceleration accepting_renderer angle ball_constraint ball_constraint_body_A ball_constraint_body_B
    ball_constraint_p_AP ball_constraint_p_BQ bushing_force_damping bushing_force_stiffness bushing_frameA
    bushing_frameC bushing_torque_damping bushing_torque_stiffness capsule child circular_arc
    collision_filter_group compliant_hydroelastic controller_gains curves damping declare_convex
    deformable_properties diffuse_map ellipsoid gear_ratio hunt_crossley_dissipation hydroelastic_margin
    hydroelastic_modulus ignored_collision_filter_group illustration_properties initial_tangent is_periodic
    joint length line_segment linear_bushing_rpy linear_spring_damper linear_spring_damper_body_A
    linear_spring_damper_body_B linear_spring_damper_damping linear_spring_damper_free_length
    linear_spring_damper_p_AP linear_spring_damper_p_BQ linear_spring_damper_stiffness mass_damping mass_density
    material_model member member_group mesh_resolution_hint mimic mu_dynamic mu_static outward_normal parent
    perception_properties plane_normal point_contact_stiffness point_on_plane poissons_ratio
    proximity_properties radius relaxation_time rigid_hydroelastic rotor_inertia screw_thread_pitch
    soft_hydroelastic stiffness_damping tendon_constraint tendon_constraint_damping tendon_constraint_joint
    tendon_constraint_lower_limit tendon_constraint_offset tendon_constraint_stiffness
    tendon_constraint_upper_limit visual wall_boundary_condition youngs_modulus
"""

_WORDS = {"drake": frozenset(_DRAKE.split())}
"""The words of each prefix. It is also the name of the dialect."""


def dialect_of(element: XmlElement, name: str) -> tuple[str, str] | None:
    """The prefix and the word of an element or attribute, where the prefix is that of a known reader."""
    prefix = prefix_of(element, name)
    return (prefix, name.partition("}")[2]) if prefix in _WORDS else None


def words_of(prefix: str) -> frozenset[str]:
    """What the reader that a prefix stands for knows."""
    return _WORDS[prefix]
