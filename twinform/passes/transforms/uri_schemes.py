"""URI schemes of meshes and textures: `package://` of ROS and `model://` of Gazebo.

An annotation records which scheme a URI had where the reverse conversion would write another:

    <tf:mesh scheme="package"/>   <tf:texture scheme="package"/>
"""

ROS, GAZEBO = "package", "model"
FUEL_SERVERS = ("fuel.gazebosim.org", "fuel.ignitionrobotics.org")
"""Where Gazebo fetches models: one server under its name of today and the older one."""
MESH_SCHEME, TEXTURE_SCHEME = "mesh", "texture"
"""The annotations on a visual or collision."""


def package_uri(uri: str) -> tuple[str, bool]:
    """A URI of SDF as URDF has it, and whether the reverse conversion would write another one."""
    return with_scheme(uri, ROS, GAZEBO), scheme_of(uri) == ROS


def model_uri(uri: str) -> tuple[str, bool]:
    """A URI of URDF as SDF has it, and whether the reverse conversion would write another one."""
    return with_scheme(uri, GAZEBO, ROS), scheme_of(uri) == GAZEBO


def with_scheme(uri: str, scheme: str, instead_of: str) -> str:
    """The URI with a scheme in the place of another, if it has that one."""
    # Gazebo looks `model://` up in its resource path and ROS `package://` in its own; both name a
    # folder and a path in it, so the text behind the scheme stays.
    old = f"{instead_of}://"
    return f"{scheme}://{uri[len(old) :]}" if uri.startswith(old) else uri


def scheme_of(uri: str | None) -> str:
    """What stands before `://`; empty where nothing does."""
    return (uri or "").partition("://")[0] if "://" in (uri or "") else ""
