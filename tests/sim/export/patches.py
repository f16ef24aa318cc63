"""Positions of image patches by OpenCV."""

import cv2


def offset_of_patch(a, b, at, seen, half=6, reach=4):
    """Returns the distance of a patch from its expected position; empty for a cropped or flat patch."""
    row, col = at
    u, v = seen
    u0, v0 = int(round(u)), int(round(v))
    far = half + reach + 1
    inside = min(row, col, u0, v0) >= far and max(row, v0) < a.shape[0] - far and max(col, u0) < a.shape[1] - far
    if not inside:
        return []
    patch = a[row - half:row + half + 1, col - half:col + half + 1]
    if patch.std() < 6:
        return []
    window = b[v0 - half - reach:v0 + half + reach + 1, u0 - half - reach:u0 + half + reach + 1]
    score = cv2.matchTemplate(window, patch, cv2.TM_CCOEFF_NORMED)
    _, best, _, (du, dv) = cv2.minMaxLoc(score)
    if best < 0.8 or not (0 < du < 2 * reach and 0 < dv < 2 * reach):
        return []

    def peak(before, middle, after):
        return 0.5 * (before - after) / (before - 2 * middle + after)

    return [(u0 + du - reach + peak(*score[dv, du - 1:du + 2]) - u,
             v0 + dv - reach + peak(*score[dv - 1:dv + 2, du]) - v)]
