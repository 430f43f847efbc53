"""The soil databases .dss and .dst: one schema, a writer that survives a kill, a reader."""
