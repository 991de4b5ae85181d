import type { Page } from '../page';

function Laboratory() {
  return <div class="page" />;
}

export const page: Page = {
  id: 'laboratory',
  title: 'Laboratory',
  summary: 'Tables and figures of the papers, run from here.',
  component: Laboratory,
};
