"""Solids solved by CalculiX (`ccx`, Debian package calculix-ccx): truths of another model.

deck.py makes meshes, writes decks and runs them, and says what a rigid end does to a solid;
sheet.py and channel.py are the cases.
"""
