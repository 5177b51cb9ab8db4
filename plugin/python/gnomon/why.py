"""Why a picture shows no shadow."""


def reasons(chain, shadows):
    """Return the reasons that are known, as sentences.

    Parameters
    ----------
    chain : list of vtkRenderPass
        The renderer's pass, and those within.
    shadows : dict or None
        What the last frame of its pass reports; None without a pass of Gnomon's.
    """
    names = [each.GetClassName() for each in chain]
    if shadows is None or "vtkGnomonShadowPass" not in names:
        by = " around ".join(names) or "no pass"
        return [f"The renderer has no shadows: it is drawn by {by}. See add_shadows."]
    found = []
    if shadows["route"] == "none":
        found.append(f"The last frame has no shadows: {shadows['route_reason']}.")
    for light in shadows["lights"]:
        if not light["casts"]:
            found.append(f"Light {light['scene_index']} casts nothing: {light['reason']}.")
    for text in shadows["misfits"] + shadows["notes"]:
        found.append(text[:1].upper() + text[1:].rstrip(".") + ".")
    if not shadows["route"]:
        found.append("Nothing was drawn yet.")
    return found or ["All lights cast, and nothing is left out."]
