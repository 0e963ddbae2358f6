"""Passes that change how a model is built: names, joints, roots, models in models."""
