"""Model folders of Gazebo: a model.config, an SDF file for each version, meshes, textures and a thumbnail."""
