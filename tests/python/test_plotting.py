"""Pictures of a frame with its labels, against the labels that the package reads."""
import io
import unittest

import common
import numpy as np
import throng
from PIL import Image


def panels(figure):
    """Title and shown image of each panel."""
    return {ax.texts[0].get_text(): ax for ax in figure.axes if ax.texts}


class ShowLabels(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.dataset = throng.Dataset(common.dataset_folder())
        cls.frame = max(cls.dataset, key=lambda frame: len(frame.people))

    def test_each_label_that_the_dataset_has_is_a_panel(self):
        figure = throng.show_labels(self.frame)
        people = f"boxes: {len(self.frame.people)} people"
        self.assertEqual(list(panels(figure)), ["color", people, "masks", "classes", "depth", "density"])
        for title, ax in panels(figure).items():
            self.assertEqual(ax.images[0].get_array().shape, (self.frame.height, self.frame.width, 3), title)
        self.assertEqual(len(panels(figure)[people].patches), len(self.frame.people))

    def test_classes_have_the_colors_of_the_dataset(self):
        shown = panels(throng.show_labels(self.frame))["classes"].images[0].get_array()
        color = next(c["color"] for c in self.dataset.info["semantic_classes"] if c["name"] == "person")
        is_person = self.frame.semantic() == self.dataset.semantic_classes["person"]
        self.assertGreater(is_person.sum(), 10)
        self.assertTrue((shown[is_person] == color).all())

    def test_near_is_brighter_than_far_and_the_most_crowded_place_is_brightest(self):
        shown = panels(throng.show_labels(self.frame, columns=2))
        depth_m = self.frame.depth()
        near, far = (np.unravel_index(np.nanargmin(depth_m * sign), depth_m.shape) for sign in (1, -1))
        brightness = shown["depth"].images[0].get_array().sum(axis=2)
        self.assertGreater(brightness[near], brightness[far] + 50)
        density = shown["density"].images[0].get_array().sum(axis=2)
        self.assertGreater(density[np.unravel_index(self.frame.density().argmax(), density.shape)], density.mean() + 50)

    def test_it_is_saved_without_a_margin(self):
        file = io.BytesIO()
        throng.show_labels(self.frame, columns=3, width_in=6).savefig(file, dpi=100)
        with Image.open(file) as picture:
            self.assertEqual(picture.size, (600, round(2 * 200 * self.frame.height / self.frame.width)))


if __name__ == "__main__":
    common.main()
