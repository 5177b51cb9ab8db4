"""Why a picture shows no shadow."""


def reasons(renderer, shadows, name_chain):
    """Return the reasons that are known, as sentences.

    Parameters
    ----------
    renderer : vtkRenderer
    shadows : dict or None
        What the last frame of its pass reports; None without a pass of Gnomon's.
    name_chain : callable
        Returns the names of a pass and its delegates.
    """
    drawn_by = renderer.GetPass()
    if shadows is None or drawn_by is None or "vtkGnomonShadowPass" not in name_chain(drawn_by):
        by = "no pass" if drawn_by is None else name_chain(drawn_by)
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
