"""From a scene to the discrete equations that it needs, and back to results on a grid."""
