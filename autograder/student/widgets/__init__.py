"""What questions look like as widgets; those of each kind are in the kind's folder.

Nothing here is imported before a widget is really shown.
"""
