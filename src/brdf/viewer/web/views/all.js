// The field's views of a material, in the order of their buttons.

import { albedo } from "./albedo.js";
import { image } from "./image.js";
import { lobe } from "./lobe.js";
import { polar } from "./polar.js";
import { slices } from "./slices.js";

export const VIEWS = [polar, lobe, slices, albedo, image];
