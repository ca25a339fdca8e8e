"""Names for wrong responses that no author thought of, by how they relate to what is right."""
