"""sRGB to linear light and CIE XYZ, and CIELAB's L, for the scripts here that measure colors of images."""
import numpy

TO_XYZ = numpy.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])


def linear(values):
    """Linear light, 0 to 1, of sRGB bytes of any shape."""
    values = numpy.asarray(values, float) / 255
    return numpy.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)


def lightness(values):
    """L of sRGB bytes (..., 3)."""
    luminance = linear(values) @ TO_XYZ[1]
    return numpy.where(luminance > 0.008856, 116 * numpy.cbrt(luminance) - 16, 903.3 * luminance)
