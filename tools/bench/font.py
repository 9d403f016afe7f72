"""Letters for pictures without a font library: five columns of seven dots, bit 0 on top, smoothed to twice that size."""
FIRST = " "
WIDE, HIGH = 5, 8  # dots of a letter; the eighth row is below the base line
ADVANCE = 6

COLUMNS = bytes.fromhex(
    "0000000000 00005f0000 0007000700 147f147f14 242a7f2a12 2313086462 3649562050 0000070000 001c224100 0041221c00 "
    "14083e0814 08083e0808 0080600000 0808080808 0000606000 2010080402 3e5149453e 00427f4000 4261514946 2141454b31 "
    "1814127f10 2745454539 3c4a494930 0171090503 3649494936 064949291e 0000360000 0080360000 0814224100 1414141414 "
    "0041221408 0201510906 324979413e 7e1111117e 7f49494936 3e41414122 7f4141221c 7f49494941 7f09090901 3e4149497a "
    "7f0808087f 00417f4100 2040413f01 7f08142241 7f40404040 7f020c027f 7f0408107f 3e4141413e 7f09090906 3e4151215e "
    "7f09192946 4649494931 01017f0101 3f4040403f 1f2040201f 3f4038403f 6314081463 0708700807 6151494543 007f414100 "
    "0204081020 0041417f00 0402010204 4040404040 0001020400 2054545478 7f48444438 3844444420 384444487f 3854545418 "
    "087e090102 18a4a4a47c 7f08040478 00447d4000 2040443d00 7f10284400 00417f4000 7c04180478 7c08040478 3844444438 "
    "fc24242418 18242424fc 7c08040408 4854545420 043f444020 3c4040207c 1c2040201c 3c4030403c 4428102844 1ca0a0a07c "
    "4464544c44 0008364100 00007f0000 0041360800 1008081008".replace(" ", ""))


def dots(letter):
    """Rows of booleans; unknown letters are question marks."""
    at = ord(letter) - ord(FIRST)
    at = at if 0 <= at < len(COLUMNS) // WIDE else ord("?") - ord(FIRST)
    columns = COLUMNS[WIDE * at:WIDE * (at + 1)]
    return [[bool(column >> row & 1) for column in columns] for row in range(HIGH)]


def doubled(rows):
    """Twice the size with rounder corners: Scale2x (Mazzoleni 2001)."""
    at = lambda y, x: 0 <= y < len(rows) and 0 <= x < len(rows[0]) and rows[y][x]  # noqa: E731
    out = [[False] * (2 * len(rows[0])) for _ in range(2 * len(rows))]
    for y, row in enumerate(rows):
        for x, here in enumerate(row):
            up, down, left, right = at(y - 1, x), at(y + 1, x), at(y, x - 1), at(y, x + 1)
            corner = up != down and left != right
            out[2 * y][2 * x] = up if corner and left == up else here
            out[2 * y][2 * x + 1] = up if corner and up == right else here
            out[2 * y + 1][2 * x] = down if corner and left == down else here
            out[2 * y + 1][2 * x + 1] = down if corner and down == right else here
    return out
