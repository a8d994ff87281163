# SPDX-License-Identifier: MIT
"""Meshes with textures and defects, for pictures of what becomes of them."""
