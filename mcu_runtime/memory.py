"""Initial values into the memory image."""


def fill(array, start, count, value):
    """`count` slots of V or O, from `start`, get one value."""
    for slot in range(start, start + count):
        array[slot] = value


def put(array, start, values):
    """The slots of V or O from `start` get these values."""
    for value in values:
        array[start] = value
        start += 1
