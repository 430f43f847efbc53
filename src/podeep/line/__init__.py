"""Lines on the seabed: pipes and risers of large rotations, their contact, statics and results."""
