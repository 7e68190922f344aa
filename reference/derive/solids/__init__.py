"""Solids solved by CalculiX (`ccx`, Debian package calculix-ccx): reference values of another model.

deck.py makes meshes, writes and runs decks, and models rigid ends of a solid. sheet.py and channel.py are the cases.
"""
