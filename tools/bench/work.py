"""What the counters of a frame say about why it took as long as it did."""

SHARES = (  # (counter, of which counter, words)
    ("pixels_supersampled", "pixels_receiving", "{:.0f} % of the pixels took all taps"),
    ("texels_mixed", "texels", "light points disagreed in {:.0f} % of the texels"),
    ("texels_in_reach", "texels", "{:.0f} % of the texels lay within a shadow's reach"),
)
RATES = (    # (counter, of which counter, words)
    ("visibility_tests", "pixels_receiving", "{:.3g} tests a pixel"),
    ("shadow_rays", "pixels_receiving", "{:.3g} shadow rays a pixel"),
)
COUNTS = (   # (counter, words for one, words for more)
    ("rays_traced", "one ray", "{} rays"),
    ("rays_baked", "one ray in the bake", "{} rays in the bake"),
    ("rays_saved_by_agreement", "one ray saved", "{} rays saved where the first ones agreed"),
    ("occluders_drawn", "one projected triangle", "{} projected triangles"),
    ("shadow_maps_rendered", "one shadow map", "{} shadow maps"),
    ("triangles_submitted", "one triangle drawn", "{} triangles drawn"),
)
MOST = 3


def thousands(number):
    for unit, name in ((1e9, "billion"), (1e6, "million")):
        if number >= unit:
            return f"{number / unit:.3g} {name}"
    return f"{number:,}".replace(",", " ")


def facts(work):
    """A few of them, the most telling first; "" when there are none."""
    said = [words.format(100.0 * work[counter] / work[of]) for counter, of, words in SHARES
            if work.get(of) and counter in work]
    said += [words.format(work[counter] / work[of]) for counter, of, words in RATES if work.get(of) and work.get(counter)]
    said += [one if work[counter] == 1 else words.format(thousands(work[counter]))
             for counter, one, words in COUNTS if work.get(counter)]
    return ", ".join(said[:MOST])
