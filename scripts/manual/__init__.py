# SPDX-License-Identifier: MIT
"""Parts of scripts/make_site.py."""
