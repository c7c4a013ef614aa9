"""Error of pictures on their diffuse pixels: the metrics of the shared notes on other renderers. Needs numpy and OpenImageIO
(Debian: python3-numpy, python3-openimageio).

relative: sqrt(mean((I - R)^2 / (R^2 + (0.01 mean R)^2))) over the mask's pixels without the brightest 1 % of the reference
trimmed:  the same without the 1 % of pixels with the largest error: kind to fireflies
smooth:   relative error after both pictures were averaged over 9 x 9 pixels within the mask: what a denoiser might come to
bias:     mean I / mean R - 1
Luminance throughout. The noise of the reference, told from the difference of its two halves, is taken off the squares.
"""
import numpy as np

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
DARK = 0.01
SMOOTHED = 9


def read(path):
    import OpenImageIO as oiio
    pixels = oiio.ImageBuf(str(path)).get_pixels().astype(np.float64)
    return np.nan_to_num(pixels)


def channels(path, names):
    """Named channels of an .exr as arrays of height x width."""
    import OpenImageIO as oiio
    image = oiio.ImageBuf(str(path))
    have = list(image.spec().channelnames)
    pixels = image.get_pixels()
    return [pixels[:, :, have.index(n)].astype(np.float64) for n in names]


def luminance(path):
    import OpenImageIO as oiio
    image = oiio.ImageBuf(str(path))
    have = list(image.spec().channelnames)
    pixels = np.nan_to_num(image.get_pixels().astype(np.float64))
    return sum(w * pixels[:, :, have.index(n)] for w, n in zip(LUMINANCE, 'RGB'))


def box_mean(values, mask, n):
    k = n // 2
    def sums(x):
        x = np.pad(x, ((k + 1, k), (k + 1, k))).cumsum(0).cumsum(1)
        return x[n:, n:] - x[:-n, n:] - x[n:, :-n] + x[:-n, :-n]
    return sums(np.where(mask, values, 0.0)) / np.maximum(sums(mask.astype(float)), 1.0)


class Reference:
    """Two halves of the truth, their mean, and the pixels to be judged."""

    def __init__(self, mean, half1, half2, mask):
        self.mean, self.mask = mean, mask
        self.noise2 = 0.25 * (half1 - half2) ** 2  # variance of the mean of the halves, one draw of it a pixel
        smooth1, smooth2 = (box_mean(h, mask, SMOOTHED) for h in (half1, half2))
        self.smooth = box_mean(mean, mask, SMOOTHED)
        self.smooth_noise2 = 0.25 * (smooth1 - smooth2) ** 2
        values = mean[mask]
        self.floor2 = (DARK * values.mean()) ** 2
        self.kept = values < np.quantile(values, 0.99)

    def relative2(self, picture, reference):
        r = reference[self.mask]
        return (picture[self.mask] - r) ** 2 / (r * r + self.floor2), r * r + self.floor2

    def own_error(self):
        """Relative error of the reference itself, from its halves."""
        _, scale = self.relative2(self.mean, self.mean)
        return float(np.sqrt((self.noise2[self.mask] / scale)[self.kept].mean()))

    def errors(self, picture):
        e2, scale = self.relative2(picture, self.mean)
        n2 = self.noise2[self.mask] / scale
        kept = self.kept
        most = lambda x: x[x <= np.quantile(x, 0.99)].mean()
        smooth_picture = box_mean(picture, self.mask, SMOOTHED)
        s2, smooth_scale = self.relative2(smooth_picture, self.smooth)
        sn2 = self.smooth_noise2[self.mask] / smooth_scale
        root = lambda x: float(np.sqrt(max(x, 0.0)))
        values, truth = picture[self.mask], self.mean[self.mask]
        return {'relative': root(e2[kept].mean() - n2[kept].mean()), 'trimmed': root(most(e2) - most(n2)),
                'smooth': root(s2[kept].mean() - sn2[kept].mean()), 'bias': float(values.mean() / truth.mean() - 1.0)}


def diffuse_mask(parts):
    """Pixels of an .exr of `render --channels` that show one matt surface and nothing that mirrors, refracts or shines by itself,
    with such neighbours all round on the same surface."""
    specular = sum(channels(parts, ['specular.' + c for c in 'RGB']))
    albedo = sum(channels(parts, ['albedo.' + c for c in 'RGB']))
    normal = np.stack(channels(parts, ['normal.' + c for c in 'XYZ']), axis=2)
    depth, = channels(parts, ['depth.Z'])
    own = (specular == 0.0) & (albedo > 1e-3) & (depth > 0.0)
    mask = own.copy()
    for dy in (-1, 0, 1):
        for dx in (-1, 0, 1):
            roll = lambda a: np.roll(np.roll(a, dy, 0), dx, 1)
            mask &= roll(own) & ((roll(normal) * normal).sum(axis=2) > 0.98) & (abs(roll(depth) - depth) < 0.05 * depth)
            mask &= abs(roll(albedo) - albedo) < 0.05 * albedo
    mask[0] = mask[-1] = False
    mask[:, 0] = mask[:, -1] = False
    return mask
