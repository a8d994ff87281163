"""Families of hard inputs of which the meaning is known: see make_hard_inputs.py."""
