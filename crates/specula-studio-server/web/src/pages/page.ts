/** What a page is. */

import type { ComponentType } from 'preact';

export interface Page {
  /** In the address. */
  id: string;
  title: string;
  /** In a sentence, for the start page. */
  summary: string;
  component: ComponentType;
}
