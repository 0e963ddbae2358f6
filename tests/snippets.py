"""Pieces of models that many tests put into theirs: an inertial, a mesh of a triangle, an arm with one joint."""

INERTIAL = '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
STL = b"""solid tip
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 1 0
endloop
endfacet
endsolid tip
"""
ARM = f"""
<robot name="arm">
  <link name="base">{INERTIAL}</link>
  <link name="hand">{INERTIAL}</link>
  <joint name="wrist" type="revolute">
    <parent link="base"/><child link="hand"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="2" velocity="3"/>
    <safety_controller k_velocity="4"/>
  </joint>
</robot>
""".encode()
