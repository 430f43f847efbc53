"""Studies of a scene: many solutions of it, side by side."""
