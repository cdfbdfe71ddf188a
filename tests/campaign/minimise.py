"""Reduce a case in which judges disagree to the smallest one in which the same judge still disagrees."""


def disagreeing(findings):
    """Names of the judges that disagree"""
    return {item["judge"] for item in findings if item["status"] == "disagreement"}


def smallest(kind, scene, findings, judged, trials):
    """Accept simpler scenes as long as one of the judges that disagreed still does.

    judged(scene) gives findings; at most so many trials are made. Returns the scene and its findings.
    """
    judges = disagreeing(findings)
    progress = True
    while progress and trials > 0:
        progress = False
        for simpler in kind.reduce(scene):
            if trials <= 0:
                break
            trials -= 1
            found = judged(simpler)
            if disagreeing(found) & judges:
                scene, findings, progress = simpler, found, True
                break
    return scene, findings
