"""Passes on the structure of models: names, joints, roots, nested models, repeated and unwanted parts."""
