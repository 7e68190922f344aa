"""Draws a scene: members with their sections, supports, loads, motions, axes and dimensions."""
