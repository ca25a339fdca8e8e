"""A vocabulary tree and a database of images that grow large."""
