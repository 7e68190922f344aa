"""A scene drawn: members with their sections, supports, loads, motions, axes and sizes."""
