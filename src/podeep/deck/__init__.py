"""A keyword deck becomes a scene: text to fields, fields to data, every fault with its place."""
