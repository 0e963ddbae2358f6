"""The normal form of a file: its XML without the differences of spelling that mean nothing.

Two files with equal normal forms state the same in the same notation. *There and back*, from one format to the other
and back, means that the robot is the same (`twinform.diff`), and that the normal form is: every name, attribute and
text of the source that is not the spelling of a default is back, and nothing else has come along.

    form = twinform.normal_form("robot.urdf")
    form.compare(twinform.normal_form("robot_that_came_back.urdf"))

What counts, and what does not:

* An element is known by its tag and its name, in URDF's `<gazebo>` by its reference; else by its place among its like.
  The order of siblings does not count, as readers find them by their names; those without one are distinguished by it.
* Several `<gazebo>` of one reference are one, and a tag in them, such as `<mu1>`, is what it means in SDF. What they
  repeat is taken once.
* Values are of the types of the facts tables. Numbers are equal to a share of 1e-9, truths whatever way they are
  spelled; a limit of 1e16 and beyond is none. A pose is a rigid transform. URIs, names and other texts are taken
  literally.
* The notation of a rotation (`degrees`, `rotation_format`, `quat_xyzw`) counts where something is turned. What is not
  turned is so in every notation, and naming one adds nothing.
* A value equal to its default in the facts table of the file's own version states nothing. Neither does an element in
  which nothing is left, unless it means something by being there: required ones, those that may be repeated, shapes,
  materials, and what the compiler does not look into, which has to come back as it was.
* Text and attributes of what no table knows count literally, with white space folded; so does all order in there.
* Comments, processing instructions and the prefixes of namespaces do not count.
"""

from twinform.compiler.normal_form.form import DifferenceKind, Discrepancy, NormalForm, normal_form

__all__ = ["DifferenceKind", "Discrepancy", "NormalForm", "normal_form"]
