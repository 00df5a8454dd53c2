"""YADE's scene: attributes of the new classes, engines, colliders, runs and their messages."""
