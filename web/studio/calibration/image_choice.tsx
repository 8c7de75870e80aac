// Images of a board: dropped or chosen, shown, and taken out again.
import { useState } from "preact/hooks";
import { FileButton } from "../parts/elements";
import { bytesText, countText } from "../parts/format";
import { type ChosenImage, kMaxBytes, withFiles } from "./request";

interface ImageChoiceProps {
  images: ChosenImage[];
  onChange: (images: ChosenImage[]) => void;
}

export function ImageChoice({ images, onChange }: ImageChoiceProps) {
  const [refused, setRefused] = useState<string[]>([]);
  const [isOver, setOver] = useState(false);
  const add = (files: File[]) => {
    const next = withFiles(images, files);
    setRefused(next.refused);
    onChange(next.images);
  };
  const onDrop = (event: DragEvent) => {
    event.preventDefault();
    setOver(false);
    add([...(event.dataTransfer?.files ?? [])]);
  };
  const remove = (image: ChosenImage) => {
    URL.revokeObjectURL(image.url);
    onChange(images.filter((entry) => entry !== image));
  };
  const bytes = images.reduce((sum, image) => sum + image.file.size, 0);
  return (
    <fieldset>
      <legend>Images</legend>
      <div
        class={`drop ${isOver ? "over" : ""}`}
        onDragOver={(event) => {
          event.preventDefault();
          setOver(true);
        }}
        onDragLeave={() => setOver(false)}
        onDrop={onDrop}
      >
        <p>Drop images of the board here: 10 or more, near and far, tilted in all directions, also at the borders of the image.</p>
        <FileButton accept="image/jpeg,image/png" multiple onFiles={add}>
          Choose images
        </FileButton>
      </div>
      {refused.map((text) => (
        <p key={text} class="field-error" role="alert">
          {text}
        </p>
      ))}
      {bytes > kMaxBytes && (
        <p class="field-error" role="alert">
          The images have {bytesText(bytes)}; {bytesText(kMaxBytes)} can be sent at once.
        </p>
      )}
      {images.length > 0 && (
        <>
          <p class="quiet-text chosen-count" aria-live="polite">
            {countText(images.length, "image")}, {bytesText(bytes)}
          </p>
          <ul class="chosen-images">
            {images.map((image) => (
              <li key={image.name}>
                <figure>
                  <img class="image" src={image.url} alt={image.name} />
                  <figcaption class="row">
                    <span class="grow">{image.name}</span>
                    <button type="button" class="button small" aria-label={`Take out ${image.name}`} onClick={() => remove(image)}>
                      ✕
                    </button>
                  </figcaption>
                </figure>
              </li>
            ))}
          </ul>
        </>
      )}
    </fieldset>
  );
}
