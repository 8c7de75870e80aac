// Filters of images by what their labels say, with the number of images that each choice would leave.
import { type ImageIndex, type ImageSummary, kCounts, kHeights, kLight, kVisibility } from "./image_index";

export interface Facet {
  name: string; ///< in the address
  label: string;
  of: "image" | "person"; ///< an image fits if one of its people has all that is chosen
  bins: string[];
  hasBin: (item: never, bin: number) => boolean;
}

type Person = ImageSummary["people"][number];

const ofImage = (name: string, label: string, bins: string[], binOf: (image: ImageSummary) => number | null): Facet => ({
  name,
  label,
  of: "image",
  bins,
  hasBin: (image: ImageSummary, bin: number) => binOf(image) === bin,
});
const ofPerson = (name: string, label: string, bins: string[], binOf: (person: Person) => number): Facet => ({
  name,
  label,
  of: "person",
  bins,
  hasBin: (person: Person, bin: number) => binOf(person) === bin,
});

export function facetsOf({ images, states }: ImageIndex): Facet[] {
  const runs = [...new Set(images.map((image) => image.run))].sort();
  const cameras = [...new Set(images.map((image) => image.camera))].sort();
  return [
    ofImage("run", "Run", runs, (image) => runs.indexOf(image.run)),
    ofImage("camera", "Camera", cameras, (image) => cameras.indexOf(image.camera)),
    ofImage("count", "People in the image", kCounts.labels, (image) => image.count),
    ofImage("light", "Light", kLight.labels, (image) => image.light),
    ofPerson("visibility", "Visible part of a person", kVisibility.labels, (person) => person.visibility),
    ofPerson("size", "Height of a person", kHeights.labels, (person) => person.height),
    ofPerson("state", "State of a person", states, (person) => person.state),
  ];
}

/** Chosen bins by the facet's name; none: all. */
export type Choice = ReadonlyMap<string, ReadonlySet<number>>;

export function choiceOf(facets: Facet[], query: URLSearchParams): Choice {
  const chosen = (facet: Facet) =>
    new Set(
      query
        .getAll(facet.name)
        .map((label) => facet.bins.indexOf(label))
        .filter((bin) => bin >= 0),
    );
  return new Map(facets.map((facet) => [facet.name, chosen(facet)]));
}

const fits = (item: unknown, facet: Facet, choice: Choice) => {
  const bins = choice.get(facet.name);
  return !bins || bins.size === 0 || [...bins].some((bin) => facet.hasBin(item as never, bin));
};

function isChosen(image: ImageSummary, facets: Facet[], choice: Choice): boolean {
  const own = facets.filter((facet) => facet.of === "image");
  const ofPeople = facets.filter((facet) => facet.of === "person" && (choice.get(facet.name)?.size ?? 0) > 0);
  if (!own.every((facet) => fits(image, facet, choice))) return false;
  return ofPeople.length === 0 || image.people.some((person) => ofPeople.every((facet) => fits(person, facet, choice)));
}

export const chosenImages = (index: ImageIndex, facets: Facet[], choice: Choice) =>
  index.images.filter((image) => isChosen(image, facets, choice));

/** For each bin, how many images have it among those that fit the other facets. */
export function histogramOf(index: ImageIndex, facets: Facet[], choice: Choice, facet: Facet): number[] {
  const others = facets.filter((other) => other !== facet);
  const only = (bin: number): Choice => new Map([...choice, [facet.name, new Set([bin])]]);
  const candidates = chosenImages(
    index,
    others.filter((other) => other.of === "image"),
    choice,
  );
  return facet.bins.map((_, bin) => candidates.filter((image) => isChosen(image, facets, only(bin))).length);
}
