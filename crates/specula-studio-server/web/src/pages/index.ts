/** All pages, in the order of the bar. */

import { page as laboratory } from './laboratory/index';
import { page as lobes } from './lobes/index';
import type { Page } from './page';
import { page as proof } from './proof/index';
import { page as render } from './render/index';
import { page as samplers } from './samplers/index';

export const pages: Page[] = [samplers, lobes, render, proof, laboratory];
