"""Solids solved by CalculiX (`ccx`, Debian package calculix-ccx): truths of another model.

grid.py makes meshes, deck.py writes and runs them, tip.py is what a rigid end does to a solid;
sheet.py and channel.py are the cases.
"""
