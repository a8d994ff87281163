"""Parts of scripts/make_site.py."""
