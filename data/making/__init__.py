"""How each data set is made from its source; needs the dependency group ``data``."""
