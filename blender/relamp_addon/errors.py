"""What a person is told where something stands in the way."""


class Refusal(Exception):
    """One sentence that names the thing and the way out."""
